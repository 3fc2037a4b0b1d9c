(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Faces of exact points whose uncertain edges are ties: one circle or one line, all pairs of which are possible [CLO-2];
   sites that two faces have in common are a legal pair [CLO-3]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation TiedFace.
Open Scope R_scope.

(* Triangles that are joined across ties agree: faces are given by a relation of triangles that share a tied edge. *)
Inductive reached {A : Type} (across : A -> A -> Prop) : A -> A -> Prop :=
| reached_here a : reached across a a
| reached_by a b c : across a b -> reached across b c -> reached across a c.

(* Three corners in no line determine the circle: across a tie, where it holds the far corner too, the next triangle's. *)
Lemma circle_determined o o' a b c : orient a b c <> 0 -> dist o a = dist o b -> dist o a = dist o c ->
  dist o' a = dist o' b -> dist o' a = dist o' c -> o = o'.
Proof.
  intros D A C A' C'. apply dist_eq in A, C, A', C'. destruct (classic (o = o')) as [E | E]; [exact E | exfalso].
  apply D. apply (collinear (fst o' - fst o, snd o' - snd o)).
  - intros Z. apply E. injection Z as Z1 Z2. destruct o, o'. simpl in *. f_equal; lra.
  - unfold dist2 in *. unfold dot. simpl. lra.
  - unfold dist2 in *. unfold dot. simpl. lra.
Qed.

(* A triangle with its circle: corners i, j, k, centre o. *)
Record drawn : Type := Drawn { di : nat; dj : nat; dk : nat; centre : point }.
Definition circled (p : nat -> point) (t : drawn) : Prop := orient (p (di t)) (p (dj t)) (p (dk t)) <> 0 /\
  dist (centre t) (p (di t)) = dist (centre t) (p (dj t)) /\ dist (centre t) (p (di t)) = dist (centre t) (p (dk t)).
Definition corner_of (t : drawn) (v : nat) : Prop := v = di t \/ v = dj t \/ v = dk t.

(* t and s are across a tie: both are triangles, and the corners of s are on the circle of t. *)
Definition tied (p : nat -> point) (t s : drawn) : Prop := circled p t /\ circled p s /\
  forall v, corner_of s v -> dist (centre t) (p v) = dist (centre t) (p (di t)).

Theorem tied_same_circle p t s : tied p t s -> centre s = centre t /\
  dist (centre s) (p (di s)) = dist (centre t) (p (di t)).
Proof.
  intros [T [[D [A C]] H]]. pose proof (H _ (or_introl eq_refl)) as Hi.
  pose proof (H _ (or_intror (or_introl eq_refl))) as Hj. pose proof (H _ (or_intror (or_intror eq_refl))) as Hk.
  assert (E : centre s = centre t) by (apply (circle_determined _ _ (p (di s)) (p (dj s)) (p (dk s)) D); congruence).
  split; [exact E | now rewrite E].
Qed.

(* So all triangles that are joined across ties have one circle, and all their corners are on it. *)
Theorem face_one_circle p t s : circled p t -> reached (tied p) t s -> centre s = centre t /\
  forall v, corner_of s v -> dist (centre t) (p v) = dist (centre t) (p (di t)).
Proof.
  intros T R. induction R as [t | t u s H _ IH].
  - split; [reflexivity |]. destruct T as [_ [A C]]. intros v [-> | [-> | ->]]; congruence.
  - destruct (tied_same_circle p t u H) as [E F]. destruct (IH (proj1 (proj2 H))) as [E' F'].
    split; [congruence |]. intros v V. rewrite <- E, (F' v V). rewrite E in F |- *. exact F.
Qed.

(* The links of a chain of the hull: across a tie the next one is on the same line. *)
Definition in_line (p : nat -> point) (t s : nat * nat) : Prop := p (fst t) <> p (snd t) /\ p (fst s) <> p (snd s) /\
  orient (p (fst t)) (p (snd t)) (p (fst s)) = 0 /\ orient (p (fst t)) (p (snd t)) (p (snd s)) = 0.

Lemma line_carries a b c d z : a <> b -> c <> d -> orient a b c = 0 -> orient a b d = 0 -> orient c d z = 0 ->
  orient a b z = 0.
Proof.
  intros D E C F Z. destruct (zero_orient_line c d z Z) as [u [U [U1 U2]]].
  assert (K : (fst d - fst c) * fst u + (snd d - snd c) * snd u = 0) by (unfold dot in U1; lra).
  assert (L : (fst z - fst c) * fst u + (snd z - snd c) * snd u = 0) by (unfold dot in U2; lra).
  assert (M : (fst b - fst a) * (snd d - snd c) - (snd b - snd a) * (fst d - fst c) = 0) by (unfold orient in *; lra).
  assert (W : (fst b - fst a) * (snd z - snd c) - (snd b - snd a) * (fst z - fst c) = 0).
  { set (x := fst d - fst c) in *. set (y := snd d - snd c) in *.
    assert (X : (fst z - fst c) * y - (snd z - snd c) * x = 0) by (unfold orient in Z; fold x y in Z; unfold x, y in *; lra).
    set (e := fst z - fst c) in *. set (f := snd z - snd c) in *. set (g := fst b - fst a) in *. set (h := snd b - snd a) in *.
    destruct (Req_dec x 0) as [X0 | X0].
    - assert (y <> 0) by (intros Y0; apply E; unfold x, y in X0, Y0; destruct c, d; simpl in *; f_equal; lra).
      apply (Rmult_eq_reg_l y); [| assumption]. replace (y * (g * f - h * e)) with (f * (g * y - h * x) - h * (e * y - f * x)) by ring.
      rewrite M, X. ring.
    - apply (Rmult_eq_reg_l x); [| assumption]. replace (x * (g * f - h * e)) with (e * (g * y - h * x) - g * (e * y - f * x)) by ring.
      rewrite M, X. ring. }
  unfold orient in *. lra.
Qed.

Theorem chain_one_line p t s : p (fst t) <> p (snd t) -> reached (in_line p) t s ->
  orient (p (fst t)) (p (snd t)) (p (fst s)) = 0 /\ orient (p (fst t)) (p (snd t)) (p (snd s)) = 0.
Proof.
  intros T R. induction R as [t | t u s H _ IH].
  - unfold orient. split; ring.
  - destruct H as [A [C [E F]]]. destruct (IH C) as [G K]. split; now apply (line_carries _ _ (p (fst u)) (p (snd u))).
Qed.

(* Sites on one empty circle, or on a line with the whole set on one side, are possible pairs. *)
Theorem circle_pairs_possible N B p (S : nat -> Prop) o r i j : (i < N)%nat -> (j < N)%nat -> choice N B p ->
  S i -> S j -> empty_disc N p S o r -> possible N B i j.
Proof.
  intros I J P Si Sj [On Out]. left. apply (pair_possible N B i j I J). exists o.
  apply (disc_shows_possible N B _ p o r P). split; [| exact Out]. intros k _ [-> | ->]; now apply On.
Qed.

Theorem line_pairs_possible N B p (S : nat -> Prop) u m i j : (i < N)%nat -> (j < N)%nat -> choice N B p ->
  S i -> S j -> empty_half_plane N p S u m -> possible N B i j.
Proof.
  intros I J P Si Sj [U [On Out]]. apply possible_exact; [exact I | exact J |]. exists p. split; [exact P |]. right.
  exists u, m. split; [exact U |]. split; [| exact Out]. intros k _ [-> | ->]; now apply On.
Qed.

(* Two different empty circles through i and j: a legal pair; points are exact. *)
Theorem two_circles_legal N B p o w i j : (i < N)%nat -> (j < N)%nat ->
  (forall k, (k < N)%nat -> exact (B k) (p k)) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> p k <> p i /\ p k <> p j) -> p i <> p j -> o <> w ->
  dist o (p j) = dist o (p i) -> dist w (p j) = dist w (p i) ->
  (forall k, (k < N)%nat -> dist o (p i) <= dist o (p k) /\ dist w (p i) <= dist w (p k)) -> legal N B i j.
Proof.
  intros I J Ex Apart D Dow Eo Ew Out. apply (exact_witness N B i j (p i) (p j) (mix (/ 2) o w) (Ex i I) (Ex j J)).
  - apply dist_eq in Eo, Ew. pose proof (power_mix (/ 2) o w (p j) (p i)). lra.
  - intros m M Mi Mj z Z. rewrite (proj2 (Ex m M) z Z). destruct (Out m M) as [O W]. apply dist_le in O, W.
    pose proof (power_mix (/ 2) o w (p m) (p i)) as E. apply dist_eq in Eo, Ew. destruct (Apart m M Mi Mj) as [Zi Zj].
    destruct (Req_dec (dist2 (mix (/ 2) o w) (p m)) (dist2 (mix (/ 2) o w) (p i))) as [Q | Q]; [exfalso | lra].
    destruct (circles_meet_twice o w (p i) (p j) (p m) Dow D Eo Ew); try lra; contradiction.
Qed.

(* An empty circle and a line with no site beyond: the same. *)
Theorem circle_and_line_legal N B p o i j : (i < N)%nat -> (j < N)%nat ->
  (forall k, (k < N)%nat -> exact (B k) (p k)) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> p k <> p i /\ p k <> p j) -> p i <> p j ->
  dist o (p j) = dist o (p i) -> (forall k, (k < N)%nat -> dist o (p i) <= dist o (p k)) ->
  (forall k, (k < N)%nat -> 0 <= orient (p i) (p j) (p k)) -> legal N B i j.
Proof.
  intros I J Ex Apart D Eo Out Left.
  apply (tied_face_hull_edge N B i j (p i) (p j) o (dist o (p i)) (Ex i I) (Ex j J) D eq_refl Eo).
  - intros m M Mi Mj z Z. rewrite (proj2 (Ex m M) z Z). destruct (Apart m M Mi Mj). split; [now apply Out | now split].
  - intros m M Mi Mj z Z. rewrite (proj2 (Ex m M) z Z). now apply Left.
Qed.

(* Two lines with no site beyond have one place in common, when neither runs along the other. *)
Theorem two_lines_meet_once u v a b : fst u * snd v - snd u * fst v <> 0 -> dot u a = dot u b -> dot v a = dot v b -> a = b.
Proof.
  intros D U V. unfold dot in U, V. destruct a as [a1 a2], b as [b1 b2]. simpl in *.
  assert (X : (fst u * snd v - snd u * fst v) * (a1 - b1) = 0).
  { replace (_ * _) with (snd v * (fst u * a1 + snd u * a2 - (fst u * b1 + snd u * b2)) -
      snd u * (fst v * a1 + snd v * a2 - (fst v * b1 + snd v * b2))) by ring. rewrite U, V. ring. }
  assert (Y : (fst u * snd v - snd u * fst v) * (a2 - b2) = 0).
  { replace (_ * _) with (fst u * (fst v * a1 + snd v * a2 - (fst v * b1 + snd v * b2)) -
      fst v * (fst u * a1 + snd u * a2 - (fst u * b1 + snd u * b2))) by ring. rewrite U, V. ring. }
  apply Rmult_integral in X, Y. f_equal; [destruct X | destruct Y]; lra.
Qed.
