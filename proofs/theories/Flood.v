(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The flood of [WIT-FAT]: in a Delaunay triangulation, ties allowed, every triangle whose disc (or half-plane) meets
   an open convex set is joined to the triangles around a site in it, over edges between such triangles. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Orientation Disc Path Fan TiedRim Inserted.
Open Scope R_scope.

(* The cells: real triangles, and beyond hull edges the points in the cone from an inner point o. Positive on the inner
   side of the edge ab. *)
Definition side (N : nat) (p : nat -> point) (o : point) (a b : nat) (x : point) : R :=
  if Nat.eqb a N then - orient o (p b) x else if Nat.eqb b N then orient o (p a) x else orient (p a) (p b) x.

(* Positive inside of the circle, or beyond the hull edge, as [test]. *)
Definition test_at (N : nat) (p : nat -> point) (a b c : nat) (x : point) : R :=
  if Nat.eqb a N then orient (p b) (p c) x else if Nat.eqb b N then orient (p c) (p a) x
  else if Nat.eqb c N then orient (p a) (p b) x else incircle (p a) (p b) (p c) x.

(* From i, j, l over edges to triangles of which G is so. *)
Inductive reached (T G : mesh) (i j l : nat) : mesh :=
| reached_start : reached T G i j l i j l
| reached_turn a b c : reached T G i j l a b c -> reached T G i j l b c a
| reached_over a b c d : reached T G i j l a b c -> T b a d -> G b a d -> reached T G i j l b a d.

Lemma reached_more T (G H : mesh) i j l a b c : (forall x y z, G x y z -> H x y z) -> reached T G i j l a b c ->
  reached T H i j l a b c.
Proof.
  intros I R. induction R as [| a b c R IH | a b c d R IH F Q]; [constructor | now apply reached_turn |].
  apply (reached_over T H i j l a b c d IH F). now apply I.
Qed.

Lemma reached_on T G i j l a b c x y z : reached T G i j l a b c -> reached T G a b c x y z -> reached T G i j l x y
  z.
Proof.
  intros R Q. induction Q as [| x y z Q IH | x y z d Q IH F W]; [exact R | now apply reached_turn |].
  now apply (reached_over T G i j l x y z d).
Qed.

(* ---- three points ---- *)

Lemma on_both_lines u v w x : orient u v w <> 0 -> orient u v x = 0 -> orient v w x = 0 -> x = v.
Proof.
  intros D A B. pose proof (bary_x u v w x) as X. pose proof (bary_y u v w x) as Y. pose proof (bary_sum u v w x) as
    S.
  apply (scaled_point_eq (orient u v w)); [exact D | |]; [rewrite X | rewrite Y]; rewrite A, B;
    replace (orient u x w) with (orient u v w) by lra; ring.
Qed.

(* On the line ab, in terms of a third point w. *)
Lemma on_line a b w x v : orient a b x = 0 ->
  orient a b w * orient a v x = orient w a x * orient a v b /\ orient a b w * orient v b x = orient b w x * orient v
    b a.
Proof.
  intros E. split.
  - replace (orient a b w * orient a v x) with (orient w a x * orient a v b + orient a b x * orient a v w)
      by (unfold orient; ring). rewrite E. ring.
  - replace (orient a b w * orient v b x) with (orient b w x * orient v b a + orient a b x * orient v b w)
      by (unfold orient; ring). rewrite E. ring.
Qed.

Section Cells.
Variables (N : nat) (p : nat -> point) (T : mesh) (o : point).
Variable skeleton : delaunay N p (fun k => (k < N)%nat) T.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.
Variable inner : forall a b, T a b N -> orient (p a) (p b) o < 0.

Local Notation side := (side N p o).
Local Notation test_at := (test_at N p).

Definition within (a b c : nat) (x : point) : Prop := 0 <= side a b x /\ 0 <= side b c x /\ 0 <= side c a x.
Definition free (x : point) : Prop := forall m, (m < N)%nat -> x <> p m.

Lemma turn a b c : T a b c -> T b c a.
Proof. intros F. now destruct (proj1 skeleton _ _ _ F). Qed.

Lemma apart a b c : T a b c -> a <> b /\ b <> c /\ c <> a.
Proof.
  intros F. destruct (proj1 skeleton _ _ _ F) as (F1 & A & _). destruct (proj1 skeleton _ _ _ F1) as (F2 & B & _).
  destruct (proj1 skeleton _ _ _ F2) as (_ & C & _). now repeat split.
Qed.

Lemma real a b c : T a b c -> a <> N -> (a < N)%nat.
Proof. intros F A. destruct (proj1 skeleton _ _ _ F) as (_ & _ & [X | X] & _); [exact X | contradiction]. Qed.

Lemma reals a b c : T a b c -> a <> N -> b <> N -> c <> N -> (a < N)%nat /\ (b < N)%nat /\ (c < N)%nat /\
  0 < orient (p a) (p b) (p c).
Proof.
  intros F A B C. pose proof (turn _ _ _ F) as F1. pose proof (turn _ _ _ F1) as F2.
  pose proof (real _ _ _ F A). pose proof (real _ _ _ F1 B). pose proof (real _ _ _ F2 C).
  destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & O & _). auto.
Qed.

Lemma test_turn a b c x : T a b c -> test_at a b c x = test_at b c a x.
Proof.
  intros F. destruct (apart a b c F) as (A & B & C). unfold Flood.test_at.
  destruct (Nat.eqb_spec a N); destruct (Nat.eqb_spec b N); destruct (Nat.eqb_spec c N); try congruence; try lia.
  unfold incircle, orient, dist2. ring.
Qed.

Lemma side_back a b x : a <> b -> side b a x = - side a b x.
Proof.
  intros D. unfold Flood.side. destruct (Nat.eqb_spec a N); destruct (Nat.eqb_spec b N); try congruence; try lra.
  unfold orient. ring.
Qed.

(* No two sides of a cell meet but at a site. *)
Lemma one_side a b c x : T a b c -> within a b c x -> free x -> side a b x = 0 -> side b c x = 0 -> False.
Proof.
  intros F (_ & _ & W) Fr E1 E2. destruct (apart a b c F) as (A & B & C). unfold Flood.side in *.
  pose proof (turn _ _ _ F) as F1. pose proof (turn _ _ _ F1) as F2.
  destruct (Nat.eqb_spec a N) as [Ea | Ea]; destruct (Nat.eqb_spec b N) as [Eb | Eb];
    destruct (Nat.eqb_spec c N) as [Ec | Ec]; try congruence.
  - subst a. pose proof (inner _ _ F1) as I. apply (Fr b (real _ _ _ F1 Eb)).
    apply (on_both_lines o (p b) (p c)); [rewrite orient_cycle | |]; lra.
  - subst b. pose proof (inner _ _ F2) as I. assert (X : x = o).
    { apply (on_both_lines (p a) o (p c)); [rewrite <- orient_cycle | rewrite orient_cycle, orient_swap in E1 |].
      - lra.
      - unfold orient in *. lra.
      - lra. }
    subst x. lra.
  - subst c. pose proof (inner _ _ F) as I. apply (Fr b (real _ _ _ F1 Eb)).
    apply (on_both_lines (p a) (p b) o); [lra | exact E1 |]. unfold orient in *. lra.
  - destruct (reals a b c F Ea Eb Ec) as (La & Lb & Lc & O). apply (Fr b Lb).
    apply (on_both_lines (p a) (p b) (p c)); lra.
Qed.

(* Where a cell ends, the next one begins. *)
Lemma over_edge a b c d x : T a b c -> T b a d -> side a b x = 0 -> 0 < side b c x -> 0 < side c a x ->
  0 < side a d x /\ 0 < side d b x.
Proof.
  intros F G E B C. destruct (apart a b c F) as (A1 & A2 & A3). destruct (apart b a d G) as (_ & A4 & A5).
  pose proof (turn _ _ _ F) as F1. pose proof (turn _ _ _ F1) as F2.
  pose proof (turn _ _ _ G) as G1. pose proof (turn _ _ _ G1) as G2. unfold Flood.side in *.
  destruct (Nat.eqb_spec a N) as [Ea | Ea]; [| destruct (Nat.eqb_spec b N) as [Eb | Eb]].
  - subst a. destruct (Nat.eqb_spec b N); [congruence |]. destruct (Nat.eqb_spec c N); [congruence |].
    destruct (Nat.eqb_spec d N); [congruence |].
    pose proof (inner _ _ F1) as I. pose proof (inner _ _ G2) as J.
    assert (Z : orient o (p b) x = 0) by lra.
    assert (D : orient o (p b) (p c) < 0) by (rewrite orient_cycle; exact I).
    destruct (on_line o (p b) (p c) x (p d) Z) as [X Y].
    assert (orient (p c) o x < 0) by (unfold orient in *; lra).
    assert (orient o (p d) (p b) < 0) by (rewrite orient_cycle; exact J). split; nra.
  - subst b. destruct (Nat.eqb_spec c N); [congruence |]. destruct (Nat.eqb_spec d N); [congruence |].
    pose proof (inner _ _ F2) as I. pose proof (inner _ _ G1) as J.
    assert (Z : orient (p a) o x = 0) by (unfold orient in *; lra).
    assert (D : orient (p a) o (p c) < 0) by (rewrite <- orient_cycle; exact I).
    destruct (on_line (p a) o (p c) x (p d) Z) as [X Y].
    assert (orient o (p c) x < 0) by lra.
    assert (W : orient (p d) o (p a) = - orient (p a) o (p d)) by (unfold orient; ring).
    assert (J' : orient (p d) o (p a) < 0) by (rewrite orient_cycle, orient_cycle; exact J).
    assert (W' : orient (p d) o x = - orient o (p d) x) by (unfold orient; ring). split; nra.
  - assert (K : exists w, 0 < orient (p a) (p b) w * orient w (p a) x /\ 0 < orient (p a) (p b) w * orient (p b) w x
    /\
      orient (p a) (p b) w <> 0).
    { destruct (Nat.eqb_spec c N) as [Ec | Ec].
      - subst c. exists o. pose proof (inner _ _ F) as I.
        assert (orient (p b) o x = - orient o (p b) x) by (unfold orient; ring). repeat split; nra.
      - destruct (reals a b c F Ea Eb Ec) as (_ & _ & _ & O). exists (p c). repeat split; [nra | nra | lra]. }
    destruct K as (w & K1 & K2 & K3). set (D := orient (p a) (p b) w) in *.
    assert (S : 0 < D * D) by nra.
    assert (Scale : forall u v r, D * u = r * v -> 0 < D * r -> 0 < v -> 0 < u).
    { intros u v r Q P V. apply (Rmult_lt_reg_l (D * D)); [exact S |]. rewrite Rmult_0_r.
      replace (D * D * u) with (D * (D * u)) by ring. rewrite Q. replace (D * (r * v)) with (D * r * v) by ring.
      now apply Rmult_lt_0_compat. }
    destruct (Nat.eqb_spec d N) as [Ed | Ed].
    + subst d. pose proof (inner _ _ G) as J. destruct (on_line (p a) (p b) w x o E) as [X Y]. fold D in X, Y.
      assert (H : 0 < orient (p a) (p b) o) by (unfold orient in *; lra). split.
      * replace (orient o (p a) x) with (- orient (p a) o x) by (unfold orient; ring).
        apply (Scale _ (orient (p a) (p b) o) (orient w (p a) x)); [| exact K1 | exact H].
        replace (orient (p a) (p b) o) with (- orient (p a) o (p b)) by (unfold orient; ring). lra.
      * apply (Scale _ (orient (p a) (p b) o) (orient (p b) w x)); [| exact K2 | exact H].
        replace (orient (p a) (p b) o) with (- orient o (p b) (p a)) by (unfold orient; ring). lra.
    + destruct (reals b a d G Eb Ea Ed) as (_ & _ & _ & O). destruct (on_line (p a) (p b) w x (p d) E) as [X Y].
      fold D in X, Y. split.
      * apply (Scale _ _ _ X K1). now rewrite <- orient_cycle.
      * apply (Scale _ _ _ Y K2). now rewrite orient_cycle.
Qed.

Lemma inside_meets a b c x : T a b c -> a <> N -> b <> N -> c <> N -> within a b c x ->
  x <> p a -> x <> p b -> x <> p c -> 0 < test_at a b c x.
Proof.
  intros F A B C (W1 & W2 & W3) Fa Fb Fc. destruct (reals a b c F A B C) as (La & Lb & Lc & O).
  unfold Flood.side, Flood.test_at in *. destruct (Nat.eqb_spec a N); [congruence |].
  destruct (Nat.eqb_spec b N); [congruence |]. destruct (Nat.eqb_spec c N); [congruence |].
  destruct (centre_of _ _ _ O) as (w & X & Y & E). rewrite E.
  pose proof (in_triangle w (p a) (p b) (p c) x X Y O W2 W3 W1 Fa Fb Fc) as P. nra.
Qed.

(* Towards y the powers fall. *)
Lemma nearer_meets a b c d y : T a b c -> T b a d -> a <> N -> b <> N -> c <> N -> orient (p a) (p b) y < 0 ->
  0 < test_at a b c y -> 0 < test_at b a d y.
Proof.
  intros F G A B C Y M. destruct (reals a b c F A B C) as (La & Lb & Lc & O). unfold Flood.test_at in *.
  destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence |].
  destruct (Nat.eqb_spec c N); [congruence |]. destruct (Nat.eqb_spec d N) as [Ed | Ed].
  - unfold orient in *. lra.
  - destruct (reals b a d G B A Ed) as (_ & _ & Ld & O').
    destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & _ & Out). specialize (Out d Ld). unfold test in Out.
    destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence |].
    destruct (Nat.eqb_spec c N); [congruence |].
    destruct (centre_of _ _ _ O) as (v & V1 & V2 & Ev). destruct (centre_of _ _ _ O') as (w & W1 & W2 & Ew).
    rewrite Ev in M, Out. rewrite Ew.
    assert (Pv : about v (p a) y < 0) by nra. assert (Pd : 0 <= about v (p a) (p d)) by nra.
    assert (Wb : about w (p a) (p b) = 0) by (unfold about in *; lra).
    destruct (pencil v w (p a) (p b)) as [k K]; [apply distinct; auto; now destruct (apart a b c F) | exact V1 |
      exact Wb |].
    pose proof (K (p d)) as Kd. pose proof (K y) as Ky.
    assert (Wd : about w (p a) (p d) = 0) by (unfold about in *; lra).
    assert (Od : orient (p a) (p b) (p d) < 0) by (unfold orient in *; lra).
    assert (K0 : 0 <= k) by nra.
    assert (Wy : about w (p a) y < 0) by nra.
    assert (E : about w (p b) y = about w (p a) y) by (unfold about in *; lra). rewrite E. nra.
Qed.

Lemma side_continuous a b y z : continuity (fun s => side a b (mix s y z)).
Proof.
  unfold Flood.side. destruct (Nat.eqb a N); [| destruct (Nat.eqb b N)]; unfold orient, mix; simpl; reg.
Qed.

Lemma side_mix a b s y z : side a b (mix s y z) = (1 - s) * side a b y + s * side a b z.
Proof.
  unfold Flood.side. destruct (Nat.eqb a N); [| destruct (Nat.eqb b N)]; unfold orient, mix; simpl; ring.
Qed.

(* ---- along a segment ---- *)

Section Along.
Variables (G : mesh) (i j l : nat) (y z : point).
Let x s := mix s y z.
Variable first : T i j l.
Variable avoids : forall s, 0 <= s <= 1 -> free (x s).
Variable start : within i j l y.
Local Notation reached := (reached T G i j l).
Variable step : forall s s' a b c d, 0 <= s < s' -> s' <= 1 -> reached a b c -> T a b c -> T b a d -> within a b c
  (x s) ->
  side a b (x s) = 0 -> 0 < side b c (x s) -> 0 < side c a (x s) -> side a b (x s') < 0 -> G b a d.

Lemma reached_in a b c : reached a b c -> T a b c.
Proof. intros R. induction R; [exact first | now apply turn | assumption]. Qed.

Definition held (s : R) : Prop := exists a b c, reached a b c /\ within a b c (x s).

Lemma held_right a b c s : 0 <= s <= 1 -> reached a b c -> 0 <= side a b (x s) -> 0 < side b c (x s) ->
  0 < side c a (x s) -> exists e, 0 < e /\ forall r, s <= r <= s + e -> r <= 1 -> held r.
Proof.
  intros S R A B C. pose proof (reached_in _ _ _ R) as F.
  pose proof (near_and _ _ _ (near_positive _ s (side_continuous b c y z) B) (near_positive _ s (side_continuous c a
    y z) C))
    as [e1 [E1 H1]].
  destruct (Rle_lt_or_eq_dec _ _ A) as [P | Z].
  - destruct (near_positive _ s (side_continuous a b y z) P) as [e [E H]]. exists (Rmin e e1).
    pose proof (Rmin_l e e1). pose proof (Rmin_r e e1). split; [now apply Rmin_pos |]. intros r Rr _.
    exists a, b, c. split; [exact R |]. assert (Q : Rabs (r - s) <= Rmin e e1) by (rewrite Rabs_pos_eq; lra).
    destruct (H1 r ltac:(lra)). specialize (H r ltac:(lra)). unfold within, x. simpl in *. lra.
  - destruct (proj1 (proj2 (proj2 skeleton)) a b c F) as [d D].
    destruct (over_edge a b c d (x s) F D (eq_sym Z) B C) as [P Q].
    pose proof (near_and _ _ _ (near_positive _ s (side_continuous a d y z) P)
      (near_positive _ s (side_continuous d b y z) Q)) as [e [E H]].
    exists (Rmin e e1). pose proof (Rmin_l e e1). pose proof (Rmin_r e e1). split; [now apply Rmin_pos |]. intros r
      Rr R1.
    assert (L : Rabs (r - s) <= Rmin e e1) by (rewrite Rabs_pos_eq; lra).
    destruct (H1 r ltac:(lra)) as [X1 X2]. destruct (H r ltac:(lra)) as [X3 X4]. simpl in *.
    destruct (Rle_dec 0 (side a b (x r))) as [K | K].
    + exists a, b, c. split; [exact R |]. unfold within, x in *. lra.
    + apply Rnot_le_lt in K. exists b, a, d. split.
      * apply (reached_over T G i j l a b c d R D). apply (step s r a b c d); auto; try lra.
        -- split; [lra |]. destruct (Req_dec s r) as [<- |]; lra.
        -- unfold within. lra.
      * unfold within. rewrite (side_back a b) by apply (apart a b c F). unfold x in *. lra.
Qed.

Lemma held_on s : 0 <= s <= 1 -> held s -> exists e, 0 < e /\ forall r, s <= r <= s + e -> r <= 1 -> held r.
Proof.
  intros S (a & b & c & R & W). pose proof (reached_in _ _ _ R) as F. pose proof (turn _ _ _ F) as F1.
  pose proof (turn _ _ _ F1) as F2. assert (R1 : reached b c a) by now apply reached_turn.
  assert (R2 : reached c a b) by now apply reached_turn.
  pose proof (one_side a b c (x s) F W (avoids s S)) as O1. pose proof W as (A & B & C).
  assert (W1 : within b c a (x s)) by (unfold within; tauto). assert (W2 : within c a b (x s)) by (unfold within;
    tauto).
  pose proof (one_side b c a (x s) F1 W1 (avoids s S)) as O2. pose proof (one_side c a b (x s) F2 W2 (avoids s S))
    as O3.
  destruct (Req_dec (side b c (x s)) 0) as [Zb | Zb].
  - apply (held_right b c a s S R1); [lra | |].
    + destruct (Req_dec (side c a (x s)) 0); [exfalso; auto | lra].
    + destruct (Req_dec (side a b (x s)) 0); [exfalso; auto | lra].
  - destruct (Req_dec (side c a (x s)) 0) as [Zc | Zc].
    + apply (held_right c a b s S R2); [lra | | lra].
      destruct (Req_dec (side a b (x s)) 0); [exfalso; auto | lra].
    + apply (held_right a b c s S R); lra.
Qed.

Lemma not_held_near s : ~ held s -> near s (fun r => ~ held r).
Proof.
  intros No. set (all := list_prod (seq 0 (S N)) (list_prod (seq 0 (S N)) (seq 0 (S N)))).
  assert (K : near s (fun r => forall t, In t all -> reached (fst t) (fst (snd t)) (snd (snd t)) ->
    ~ within (fst t) (fst (snd t)) (snd (snd t)) (x r))).
  { apply near_list. intros (a & b & c) _. simpl.
    destruct (classic (reached a b c)) as [R | R]; [| exists 1; split; [lra | intros; contradiction]].
    assert (W : ~ within a b c (x s)) by (intros W; apply No; now exists a, b, c).
    assert (X : side a b (x s) < 0 \/ side b c (x s) < 0 \/ side c a (x s) < 0).
    { unfold within in W. destruct (Rle_dec 0 (side a b (x s))); [| left; lra].
      destruct (Rle_dec 0 (side b c (x s))); [| right; left; lra].
      destruct (Rle_dec 0 (side c a (x s))); [tauto | right; right; lra]. }
    destruct X as [X | [X | X]];
      [pose proof (near_negative _ s (side_continuous a b y z) X) as Q |
       pose proof (near_negative _ s (side_continuous b c y z) X) as Q |
       pose proof (near_negative _ s (side_continuous c a y z) X) as Q];
      revert Q; apply near_weaken; intros r Q _ (W1 & W2 & W3); unfold x in *; simpl in *; lra. }
  revert K. apply near_weaken. intros r H (a & b & c & R & W). apply (H (a, (b, c))); [| exact R | exact W].
  pose proof (reached_in _ _ _ R) as F. pose proof (turn _ _ _ F) as F1. pose proof (turn _ _ _ F1) as F2.
  assert (B : forall u v w, T u v w -> In u (seq 0 (S N))).
  { intros u v w Q. apply in_seq. destruct (Nat.eq_dec u N); [lia |]. pose proof (real _ _ _ Q n). lia. }
  unfold all. apply in_prod; [now apply (B a b c) |]. apply in_prod; [now apply (B b c a) | now apply (B c a b)].
Qed.

Theorem walk : exists a b c, reached a b c /\ within a b c z.
Proof.
  assert (H0 : held 0) by (exists i, j, l; split; [constructor | unfold x; now rewrite mix_0]).
  assert (H : forall r, 0 <= r <= 1 -> held r).
  { apply (open_closed (fun s => forall r, 0 <= r <= s -> held r)).
    - intros r R. now replace r with 0 by lra.
    - intros s S P. destruct (held_on s S (P s ltac:(lra))) as [e [E Q]]. exists e. split; [exact E |].
      intros t Lt T1 r R.
      destruct (Rle_dec r s) as [L | L]; [apply P; lra |]. apply Q; [| lra]. pose proof (Rle_abs (t - s)). lra.
    - intros s S P. assert (X : exists r, 0 <= r <= s /\ ~ held r).
      { apply NNPP. intros N0. apply P. intros r R. apply NNPP. intros Q. apply N0. now exists r. }
      destruct X as (r & R & Q). destruct (Req_dec r 0) as [-> | D]; [contradiction |].
      destruct (not_held_near r Q) as [e [E K]]. set (q := Rmax 0 (r - e)).
      assert (Iq : 0 <= q < r /\ r - e <= q) by (unfold q, Rmax; destruct (Rle_dec _ _); lra).
      exists (r - q). split; [lra |]. intros t Lt T1 H. apply (K q).
      + rewrite Rabs_left; lra.
      + apply H. split; [lra |]. pose proof (Rle_abs (s - t)) as A. rewrite Rabs_minus_sym in A. lra. }
  destruct (H 1 ltac:(lra)) as (a & b & c & R & W). exists a, b, c. split; [exact R |]. unfold x in W. now rewrite
    mix_1 in W.
Qed.
End Along.

Variable S : point -> Prop.
Variable convex : forall u v s, 0 <= s <= 1 -> S u -> S v -> S (mix s u v).
Definition met (a b c : nat) : Prop := exists y, S y /\ 0 < test_at a b c y.

(* No site is in a circle, or beyond a hull edge. *)
Lemma not_met_by_site a b c k : T a b c -> (k < N)%nat -> test_at a b c (p k) <= 0.
Proof. intros F K. destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & _ & H). exact (H k K). Qed.

(* Only the cells at a site hold it. *)
Lemma cell_at_site a b c k : T a b c -> (k < N)%nat -> within a b c (p k) -> k = a \/ k = b \/ k = c.
Proof.
  intros F K W. apply NNPP. intros No.
  assert (Off : forall m, (m < N)%nat -> m <> k -> p k <> p m) by (intros m M D; now apply distinct; auto).
  assert (Ghost : forall a b, T a b N -> within a b N (p k) -> k <> a -> k <> b -> False).
  { clear a b c F W No. intros a b F (W1 & W2 & W3) Da Db. pose proof (turn _ _ _ F) as F1. pose proof (turn _ _ _
    F1) as F2.
    destruct (apart a b N F) as (A1 & A2 & A3).
    pose proof (real _ _ _ F (not_eq_sym A3)) as La. pose proof (real _ _ _ F1 A2) as Lb.
    destruct (proj1 (proj2 (proj2 skeleton)) a b N F) as [d G]. pose proof (inner _ _ F) as I.
    assert (Ed : d <> N). { intros ->. pose proof (inner _ _ G). unfold orient in *. lra. }
    destruct (reals b a d G A2 (not_eq_sym A3) Ed) as (_ & _ & Ld & O).
    pose proof (not_met_by_site a b N k F K) as Q. assert (Z : side a b (p k) = 0).
    { unfold Flood.side, Flood.test_at in *. destruct (Nat.eqb_spec a N); [congruence |].
      destruct (Nat.eqb_spec b N); [congruence |]. rewrite Nat.eqb_refl in Q. lra. }
    assert (Z' : orient (p a) (p b) (p k) = 0).
    { unfold Flood.side in Z. destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence
      |]. exact Z. }
    assert (Dk : k <> d) by (intros ->; unfold orient in *; lra).
    assert (P2 : 0 < side b N (p k)).
    { destruct (Rle_lt_or_eq_dec _ _ W2) as [X | X]; [exact X | exfalso]. unfold Flood.side in X.
      destruct (Nat.eqb_spec b N); [congruence |]. rewrite Nat.eqb_refl in X. apply (Off b Lb (not_eq_sym Db)).
      apply (on_both_lines (p a) (p b) o); [lra | exact Z' |]. unfold orient in *. lra. }
    assert (P3 : 0 < side N a (p k)).
    { destruct (Rle_lt_or_eq_dec _ _ W3) as [X | X]; [exact X | exfalso]. unfold Flood.side in X.
      rewrite Nat.eqb_refl in X. apply (Off a La (not_eq_sym Da)).
      apply (on_both_lines o (p a) (p b)); [rewrite orient_cycle; lra | lra | exact Z']. }
    destruct (over_edge a b N d (p k) F G Z P2 P3) as [X Y].
    assert (M : 0 < test_at b a d (p k)).
    { apply inside_meets; auto. unfold within. rewrite (side_back a b) by exact A1. lra. }
    pose proof (not_met_by_site b a d k G K). lra. }
  pose proof (turn _ _ _ F) as F1. pose proof (turn _ _ _ F1) as F2. pose proof W as (W1 & W2 & W3).
  destruct (Nat.eq_dec a N) as [-> | Ea]; [apply (Ghost b c F1); [now repeat split | tauto | tauto] |].
  destruct (Nat.eq_dec b N) as [-> | Eb]; [apply (Ghost c a F2); [now repeat split | tauto | tauto] |].
  destruct (Nat.eq_dec c N) as [-> | Ec]; [apply (Ghost a b F); tauto |].
  destruct (reals a b c F Ea Eb Ec) as (La & Lb & Lc & _).
  pose proof (inside_meets a b c (p k) F Ea Eb Ec W (Off a La ltac:(intros ->; tauto)) (Off b Lb ltac:(intros ->;
    tauto))
    (Off c Lc ltac:(intros ->; tauto))). pose proof (not_met_by_site a b c k F K). lra.
Qed.

(* From a cell that holds a point of S to the cells at a site in S. *)
Theorem to_site i j l y k : T i j l -> (k < N)%nat -> within i j l y -> S y -> S (p k) ->
  (forall s, 0 <= s < 1 -> free (mix s y (p k))) -> exists u v, reached T met i j l k u v.
Proof.
  intros F K W Sy Sk Fr. set (all := list_prod (seq 0 (Datatypes.S N)) (list_prod (seq 0 (Datatypes.S N)) (seq 0
    (Datatypes.S N)))).
  assert (Near : near 1 (fun r => forall t, In t all -> T (fst t) (fst (snd t)) (snd (snd t)) ->
    within (fst t) (fst (snd t)) (snd (snd t)) (mix r y (p k)) -> k = fst t \/ k = fst (snd t) \/ k = snd (snd t))).
  { apply near_list. intros (a & b & c) _. simpl.
    destruct (classic (T a b c)) as [R | R]; [| exists 1; split; [lra | intros; contradiction]].
    destruct (classic (within a b c (p k))) as [I | W'].
    { exists 1. split; [lra |]. intros. now apply cell_at_site. }
    assert (X : side a b (p k) < 0 \/ side b c (p k) < 0 \/ side c a (p k) < 0).
    { unfold within in W'. destruct (Rle_dec 0 (side a b (p k))); [| left; lra].
      destruct (Rle_dec 0 (side b c (p k))); [| right; left; lra].
      destruct (Rle_dec 0 (side c a (p k))); [tauto | right; right; lra]. }
    rewrite <- (mix_1 y (p k)) in X.
    destruct X as [X | [X | X]];
      [pose proof (near_negative _ 1 (side_continuous a b y (p k)) X) as Q |
       pose proof (near_negative _ 1 (side_continuous b c y (p k)) X) as Q |
       pose proof (near_negative _ 1 (side_continuous c a y (p k)) X) as Q];
      revert Q; apply near_weaken; intros r Q _ (W1 & W2 & W3); simpl in *; lra. }
  destruct Near as [e [E H]]. set (q := 1 - Rmin e (1 / 2)).
  assert (Q : 0 <= q < 1 /\ 1 - q <= e) by (unfold q; pose proof (Rmin_l e (1 / 2)); pose proof (Rmin_r e (1 / 2));
    assert (0 < Rmin e (1 / 2)) by (apply Rmin_pos; lra); lra).
  assert (X : forall s, mix s y (mix q y (p k)) = mix (s * q) y (p k)) by (intros; unfold mix; simpl; f_equal; ring).
  assert (Iq : forall s, 0 <= s <= 1 -> 0 <= s * q < 1) by (intros s Hs; nra).
  destruct (walk met i j l y (mix q y (p k)) F) as (a & b & c & R & V).
  - intros s Hs. rewrite X. now apply Fr, Iq.
  - exact W.
  - intros s s' a b c d Hs Hs' _ Fa Ga V Z B C Neg. destruct (apart a b c Fa) as (A1 & A2 & A3).
    destruct (apart b a d Ga) as (_ & A4 & A5).
    destruct (over_edge a b c d _ Fa Ga Z B C) as [P1 P2].
    pose proof (Fr (s * q) (Iq s ltac:(lra))) as Fs. rewrite X in P1, P2, Z.
    assert (Ss : S (mix (s * q) y (p k))) by (apply convex; [specialize (Iq s); lra | exact Sy | exact Sk]).
    destruct (Nat.eq_dec a N) as [Ea | Ea]; [| destruct (Nat.eq_dec b N) as [Eb | Eb];
      [| destruct (Nat.eq_dec d N) as [Ed | Ed]]].
    + subst a. exists (mix (s * q) y (p k)). split; [exact Ss |]. unfold Flood.side, Flood.test_at in *.
      rewrite Nat.eqb_refl. destruct (Nat.eqb_spec b N); [congruence |]. destruct (Nat.eqb_spec d N); [congruence |
        exact P2].
    + subst b. exists (mix (s * q) y (p k)). split; [exact Ss |]. unfold Flood.side, Flood.test_at in *.
      rewrite Nat.eqb_refl. destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec d N); [congruence |
        exact P1].
    + subst d. exists (mix (s' * q) y (p k)). split; [apply convex; [specialize (Iq s'); lra | exact Sy | exact Sk]
      |].
      rewrite X in Neg. unfold Flood.side, Flood.test_at in *. rewrite Nat.eqb_refl.
      destruct (Nat.eqb_spec b N); [congruence |]. destruct (Nat.eqb_spec a N); [congruence |]. unfold orient in *.
        lra.
    + exists (mix (s * q) y (p k)). split; [exact Ss |]. destruct (reals b a d Ga Eb Ea Ed) as (Lb & La & Ld & _).
      apply inside_meets; auto. unfold within. rewrite (side_back a b) by exact A1. lra.
  - assert (Fa : T a b c) by (apply (reached_in met i j l F a b c R)).
    pose proof (turn _ _ _ Fa) as F1. pose proof (turn _ _ _ F1) as F2.
    assert (Be : forall u v w, T u v w -> In u (seq 0 (Datatypes.S N))).
    { intros u v w G. apply in_seq. destruct (Nat.eq_dec u N) as [-> | D]; [lia |]. pose proof (real _ _ _ G D).
      lia. }
    assert (At : k = a \/ k = b \/ k = c).
    { apply (H q ltac:(rewrite Rabs_left; lra) (a, (b, c))); [| exact Fa | exact V].
      unfold all. apply in_prod; [now apply (Be a b c) |]. apply in_prod; [now apply (Be b c a) | now apply (Be c a
        b)]. }
    destruct At as [-> | [-> | ->]]; [now exists b, c | exists c, a | exists a, b].
    + now apply reached_turn.
    + now apply reached_turn, reached_turn.
Qed.

(* From a triangle in whose circle y is to a cell that holds y, all of them in conflict with y. *)
Lemma reached_test y i j l a b c : T i j l -> 0 < test_at i j l y ->
  reached T (fun u v w => 0 < test_at u v w y) i j l a b c -> 0 < test_at a b c y.
Proof.
  intros F M R. induction R as [| a b c R IH | a b c d R IH G Q]; [exact M | | exact Q].
  rewrite <- test_turn; [exact IH |]. now apply (reached_in (fun u v w => 0 < test_at u v w y) i j l F).
Qed.

Theorem to_point i j l y : T i j l -> within i j l o -> 0 < test_at i j l y ->
  (forall s, 0 <= s <= 1 -> free (mix s o y)) ->
  exists a b c, reached T (fun u v w => 0 < test_at u v w y) i j l a b c /\ within a b c y.
Proof.
  intros F W M Fr. apply (walk (fun u v w => 0 < test_at u v w y) i j l o y F Fr W).
  intros s s' a b c d Hs Hs' R Fa Ga V Z B C Neg. pose proof (reached_test y i j l a b c F M R) as Ma.
  rewrite side_mix in Z, Neg. pose proof (turn _ _ _ Fa) as F1. pose proof (turn _ _ _ F1) as F2.
  destruct (apart a b c Fa) as (A1 & A2 & A3). rewrite side_mix in B, C.
  destruct (Nat.eq_dec a N) as [Ea | Ea]; [| destruct (Nat.eq_dec b N) as [Eb | Eb]].
  - exfalso. subst a. pose proof (inner _ _ F1) as I. unfold Flood.side in *. rewrite Nat.eqb_refl in Z, Neg.
    destruct (Nat.eqb_spec b N); [congruence |]. destruct (Nat.eqb_spec c N); [congruence |].
    replace (orient o (p b) o) with 0 in Z, Neg by (unfold orient; ring).
    assert (s = 0) by nra. subst s. lra.
  - exfalso. subst b. pose proof (inner _ _ F2) as I. unfold Flood.side in *. rewrite Nat.eqb_refl in Z, Neg.
    destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec c N); [congruence |].
    replace (orient o (p a) o) with 0 in Z, Neg by (unfold orient; ring).
    assert (s = 0) by nra. subst s. lra.
  - assert (E : forall u, side a b u = orient (p a) (p b) u).
    { intros u. unfold Flood.side. destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N);
      [congruence |].
      reflexivity. }
    rewrite !E in Z, Neg. set (A := orient (p a) (p b) o) in *. set (Y := orient (p a) (p b) y) in *.
    assert (L : Y < A) by nra. assert (Y0 : Y < 0) by nra.
    destruct (Nat.eq_dec c N) as [-> | Ec].
    + exfalso. pose proof (inner _ _ Fa) as I. fold A in I. nra.
    + now apply (nearer_meets a b c d y).
Qed.
End Cells.
