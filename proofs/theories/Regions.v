(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The search for Voronoi vertices by bisection of boxes of centres loses none of a listed triangle [REGION-1]. *)
From Coq Require Import Reals Lra Lia List.
From Dyadel Require Import Plane Distance Cells Legal Orientation.
Import ListNotations.
Open Scope R_scope.

Lemma ratio lo hi x : lo <= x <= hi -> exists t, 0 <= t <= 1 /\ x = (1 - t) * lo + t * hi.
Proof.
  intros L. destruct (Rle_lt_or_eq_dec lo hi ltac:(lra)) as [W | <-]; [| exists 0; split; lra].
  exists ((x - lo) / (hi - lo)). split; [| field; lra]. split.
  - apply Rle_mult_inv_pos; lra.
  - apply Rmult_le_reg_r with (hi - lo); [lra |]. replace ((x - lo) / (hi - lo) * (hi - lo)) with (x - lo) by (field; lra).
    lra.
Qed.

(* A site that is always nearer at the four corners is so in all of the box. *)
Theorem corners_block X Y Q : (forall z, corner z Q -> dl z X < ds z Y) -> forall z, inside z Q -> dl z X < ds z Y.
Proof.
  intros H [x y] [Hx Hy]. cbn [fst snd] in *. destruct (ratio _ _ _ Hx) as (t & T & Ex). destruct (ratio _ _ _ Hy) as (s & S
    & Ey).
  assert (Row : forall v, v = ylo Q \/ v = yhi Q -> dl (x, v) X < ds (x, v) Y).
  { intros v V. replace (x, v) with (mix t (xlo Q, v) (xhi Q, v)) by (unfold mix; cbn; f_equal; [lra | ring]).
    apply closer_rect_convex; [exact T | |]; apply H; split; cbn; auto. }
  replace (x, y) with (mix s (x, ylo Q) (x, yhi Q)) by (unfold mix; cbn; f_equal; [ring | lra]).
  apply closer_rect_convex; [exact S | |]; apply Row; auto.
Qed.

Section Search.
Variable N : nat.
Variable B : sites.

(* Some site is nearer than i in all of the box, as ranges of distances say, or those at its corners. *)
Definition kept_out (Q : rect) (i : nat) : Prop := exists k, (k < N)%nat /\
  ((forall z, inside z Q -> dl z (B k) < ds z (B i)) \/ forall z, corner z Q -> dl z (B k) < ds z (B i)).

(* Lists of sites and of pairs, and their rest in a box. *)
Definition lists : Type := (list nat * list (nat * nat))%type.
Definition cut (Q : rect) (l l' : lists) : Prop :=
  (forall i, In i (fst l) -> In i (fst l') \/ kept_out Q i) /\
  (forall i j, In (i, j) (snd l) -> In i (fst l') -> In j (fst l') -> In (i, j) (snd l')).

(* Fewer than three sites, or no pair. *)
Definition spent (l : lists) : Prop := (forall i j k, In i (fst l) -> In j (fst l) -> In k (fst l) -> i = j \/ i = k \/
  j = k) \/ snd l = [].

(* From one enclosure to the next, by a box and by several ones. *)
Inductive looked : rect -> lists -> (point -> Prop) -> (point -> Prop) -> Prop :=
| looked_within Q l (F : point -> Prop) : (forall z, inside z Q -> F z) -> looked Q l F F
| looked_spent Q l l' F : cut Q l l' -> spent l' -> looked Q l F F
| looked_found Q l (F F' : point -> Prop) : (forall z, F z -> F' z) -> (forall z, inside z Q -> F' z) -> looked Q l F F'
| looked_parts Q l l' parts F F' : cut Q l l' -> (forall z, inside z Q -> exists P, In P parts /\ inside z P) ->
    all_looked parts l' F F' -> looked Q l F F'
with all_looked : list rect -> lists -> (point -> Prop) -> (point -> Prop) -> Prop :=
| none_looked l F : all_looked [] l F F
| next_looked P parts l F F' F'' : looked P l F F' -> all_looked parts l F' F'' -> all_looked (P :: parts) l F F''.

Scheme looked_ind2 := Minimality for looked Sort Prop
with all_looked_ind2 := Minimality for all_looked Sort Prop.
Combined Scheme looked_both from looked_ind2, all_looked_ind2.

(* Rounds: each cuts the lists for the whole box, looks into it, and continues with a box around all that was found. *)
Inductive shrunk : rect -> lists -> rect -> Prop :=
| shrunk_end Q l : shrunk Q l Q
| shrunk_round Q l l' F Q' Q'' : cut Q l l' -> looked Q l' (fun _ => False) F -> (forall z, F z -> inside z Q') ->
    shrunk Q' l' Q'' -> shrunk Q l Q''.

(* Three different sites, two of which are a listed pair, each of which may be the nearest to c. *)
Definition vertex (l : lists) (c : point) : Prop := exists i j k, i <> j /\ i <> k /\ j <> k /\ In (i, j) (snd l) /\
  In i (fst l) /\ In j (fst l) /\ In k (fst l) /\ pos N B i c /\ pos N B j c /\ pos N B k c.

Lemma possible_stays Q l l' c i : cut Q l l' -> inside c Q -> pos N B i c -> In i (fst l) -> In i (fst l').
Proof.
  intros [S _] C P I. destruct (S i I) as [H | (k & K & H)]; [exact H |]. exfalso. specialize (P k K).
  destruct H as [H | H]; [specialize (H c C) | pose proof (corners_block _ _ _ H c C)]; lra.
Qed.

Lemma vertex_stays Q l l' c : cut Q l l' -> inside c Q -> vertex l c -> vertex l' c.
Proof.
  intros D C (i & j & k & IJ & IK & JK & P & I & J & K & A & E & G). exists i, j, k.
  pose proof (possible_stays Q l l' c i D C A I) as I'. pose proof (possible_stays Q l l' c j D C E J) as J'.
  pose proof (possible_stays Q l l' c k D C G K). pose proof (proj2 D i j P I' J'). auto 12.
Qed.

Lemma looked_holds :
  (forall Q l F F', looked Q l F F' -> (forall z, F z -> F' z) /\ forall c, inside c Q -> vertex l c -> F' c) /\
  (forall parts l F F', all_looked parts l F F' -> (forall z, F z -> F' z) /\
    forall c P, In P parts -> inside c P -> vertex l c -> F' c).
Proof.
  apply looked_both.
  - intros Q l F W. split; [auto |]. intros c C _. now apply W.
  - intros Q l l' F D S. split; [auto |]. intros c C V. exfalso.
    destruct (vertex_stays Q l l' c D C V) as (i & j & k & IJ & IK & JK & P & I & J & K & _).
    destruct S as [S | S]; [destruct (S i j k I J K) as [E | [E | E]]; auto | now rewrite S in P].
  - intros Q l F F' W X. split; [exact W |]. intros c C _. now apply X.
  - intros Q l l' parts F F' D Cover _ [W H]. split; [exact W |]. intros c C V. destruct (Cover c C) as (P & I & Z).
    apply (H c P I Z). now apply (vertex_stays Q l).
  - intros l F. split; [auto |]. intros c P [].
  - intros P parts l F F' F'' _ [W H] _ [W' H']. split; [auto |]. intros c P' [<- | I] Z V; [apply W', H | apply (H' c P')];
      auto.
Qed.

Theorem rounds_hold Q l Q' c : shrunk Q l Q' -> inside c Q -> vertex l c -> inside c Q'.
Proof.
  intros S. induction S as [Q l | Q l l' F Q' Q'' D L E _ IH]; intros C V; [exact C |].
  pose proof (vertex_stays Q l l' c D C V) as V'. apply IH; [| exact V'].
  apply E. now apply (proj1 looked_holds Q l' (fun _ => False) F).
Qed.

(* So the box of a face holds the Voronoi vertices of every choice that are in the window, of three sites that are
   listed, one pair of them too. *)
Theorem region_holds Q l Q' p c i j k : shrunk Q l Q' -> choice N B p -> inside c Q -> i <> j -> i <> k -> j <> k ->
  (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> In i (fst l) -> In j (fst l) -> In k (fst l) -> In (i, j) (snd l) ->
  cell N p i c -> cell N p j c -> cell N p k c -> inside c Q'.
Proof.
  intros S P C IJ IK JK I J K Li Lj Lk L Ci Cj Ck. apply (rounds_hold Q l Q' c S C). exists i, j, k.
  do 7 (split; [assumption |]). split; [| split]; apply pos_exact; auto; exists p; auto.
Qed.
End Search.
