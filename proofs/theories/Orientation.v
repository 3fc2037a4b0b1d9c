(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Corners decide the orientation of three rectangles; it is unsure iff a line meets all three. *)
From Coq Require Import Reals Lra Psatz Classical.
From Dyadel Require Import Plane Distance.
Open Scope R_scope.

(* Positive iff a, b, c make a left turn, 0 iff they lie on a line. *)
Definition orient (a b c : point) : R :=
  (fst b - fst a) * (snd c - snd a) - (snd b - snd a) * (fst c - fst a).

Definition corner (z : point) (B : rect) : Prop :=
  (fst z = xlo B \/ fst z = xhi B) /\ (snd z = ylo B \/ snd z = yhi B).

(* Every choice makes a left turn; every choice makes a right turn. *)
Definition surely_left (A B C : rect) : Prop :=
  forall a b c, inside a A -> inside b B -> inside c C -> 0 < orient a b c.
Definition surely_right (A B C : rect) : Prop :=
  forall a b c, inside a A -> inside b B -> inside c C -> orient a b c < 0.

Lemma corner_inside z B : corner z B -> inside z B.
Proof.
  pose proof (x_ordered B). pose proof (y_ordered B). intros [[X | X] [Y | Y]]; unfold inside; rewrite X, Y; repeat split; lra.
Qed.

Lemma affine_ends u v lo hi x : lo <= x <= hi -> 0 < u * lo + v -> 0 < u * hi + v -> 0 < u * x + v.
Proof. intros. destruct (Rle_lt_dec 0 u); nra. Qed.

Lemma affine_on_rect u v w B z : (forall s, corner s B -> 0 < u * fst s + v * snd s + w) ->
  inside z B -> 0 < u * fst z + v * snd z + w.
Proof.
  intros H [X Y].
  assert (G : forall x, x = xlo B \/ x = xhi B -> 0 < u * x + v * snd z + w).
  { intros x Hx. replace (u * x + v * snd z + w) with (v * snd z + (u * x + w)) by ring.
    apply affine_ends with (ylo B) (yhi B); [exact Y | |].
    - specialize (H (x, ylo B)). simpl in H. apply Rlt_le_trans with (u * x + v * ylo B + w); [| lra].
      apply H. split; simpl; [exact Hx | now left].
    - specialize (H (x, yhi B)). simpl in H. apply Rlt_le_trans with (u * x + v * yhi B + w); [| lra].
      apply H. split; simpl; [exact Hx | now right]. }
  replace (u * fst z + v * snd z + w) with (u * fst z + (v * snd z + w)) by ring.
  apply affine_ends with (xlo B) (xhi B); [exact X | |].
  - pose proof (G (xlo B) (or_introl eq_refl)). lra.
  - pose proof (G (xhi B) (or_intror eq_refl)). lra.
Qed.

Lemma orient_affine a b c :
  orient a b c = (snd b - snd c) * fst a + (fst c - fst b) * snd a + (fst b * snd c - snd b * fst c).
Proof. unfold orient. ring. Qed.

Lemma orient_cycle a b c : orient a b c = orient b c a.
Proof. unfold orient. ring. Qed.

Lemma orient_swap a b c : orient a c b = - orient a b c.
Proof. unfold orient. ring. Qed.

Lemma corners_of_first A b c : (forall s, corner s A -> 0 < orient s b c) -> forall a, inside a A -> 0 < orient a b c.
Proof.
  intros H a Ia. rewrite orient_affine. apply affine_on_rect with A; [| exact Ia].
  intros s Hs. rewrite <- orient_affine. now apply H.
Qed.

(* For b, c given, the least value over a rectangle is at the corner that the signs of b's and c's differences name. *)
Theorem least_at_corner A b c a : inside a A ->
  corner (lowest (snd b - snd c, fst c - fst b) A) A /\
  orient (lowest (snd b - snd c, fst c - fst b) A) b c <= orient a b c.
Proof.
  intros I. split.
  - unfold corner, lowest. simpl. destruct (Rle_dec 0 (snd b - snd c)); destruct (Rle_dec 0 (fst c - fst b)); tauto.
  - destruct (lowest_spec (snd b - snd c, fst c - fst b) A) as [_ H]. specialize (H a I).
    rewrite !orient_affine. unfold dot in H. cbn [fst snd] in H. lra.
Qed.

(* The 64 corner choices decide. *)
Theorem corners_decide_left A B C :
  surely_left A B C <-> (forall a b c, corner a A -> corner b B -> corner c C -> 0 < orient a b c).
Proof.
  split; intros H.
  - intros a b c Ha Hb Hc. apply H; now apply corner_inside.
  - intros a b c Ia Ib Ic. apply (corners_of_first A); [| exact Ia]. intros s Hs.
    rewrite orient_cycle. apply (corners_of_first B); [| exact Ib]. intros t Ht.
    rewrite orient_cycle. apply (corners_of_first C); [| exact Ic]. intros w Hw.
    rewrite orient_cycle. now apply H.
Qed.

Lemma surely_right_left A B C : surely_right A B C <-> surely_left A C B.
Proof.
  split; intros H a b c Ia Ib Ic.
  - rewrite orient_swap. pose proof (H a c b Ia Ic Ib). lra.
  - rewrite orient_swap. pose proof (H a c b Ia Ic Ib). lra.
Qed.

Theorem corners_decide_right A B C :
  surely_right A B C <-> (forall a b c, corner a A -> corner b B -> corner c C -> orient a b c < 0).
Proof.
  rewrite surely_right_left, corners_decide_left. split; intros H a b c Ha Hb Hc.
  - rewrite orient_swap. pose proof (H a c b Ha Hc Hb). lra.
  - rewrite orient_swap. pose proof (H a c b Ha Hc Hb). lra.
Qed.

(* Three points on a line: their scalar products with a normal u agree. *)
Lemma collinear u a b c : u <> (0, 0) -> dot u a = dot u b -> dot u a = dot u c -> orient a b c = 0.
Proof.
  destruct u as [p q]. intros U H G. unfold dot, orient in *. simpl in *.
  destruct (Req_dec p 0) as [P | P].
  - assert (Q : q <> 0) by (intros ->; apply U; now rewrite P).
    apply (Rmult_eq_reg_l q); [| exact Q].
    transitivity ((fst b - fst a) * (q * (snd c - snd a)) - (q * (snd b - snd a)) * (fst c - fst a)); [ring |].
    replace (q * (snd c - snd a)) with (- p * (fst c - fst a)) by lra.
    replace (q * (snd b - snd a)) with (- p * (fst b - fst a)) by lra. ring.
  - apply (Rmult_eq_reg_l p); [| exact P].
    transitivity ((p * (fst b - fst a)) * (snd c - snd a) - (snd b - snd a) * (p * (fst c - fst a))); [ring |].
    replace (p * (fst c - fst a)) with (- q * (snd c - snd a)) by lra.
    replace (p * (fst b - fst a)) with (- q * (snd b - snd a)) by lra. ring.
Qed.

Definition line_meets_all (A B C : rect) : Prop :=
  exists u m, u <> (0, 0) /\ (exists a, inside a A /\ dot u a = m) /\ (exists b, inside b B /\ dot u b = m) /\
    (exists c, inside c C /\ dot u c = m).

Lemma zero_orient_line a b c : orient a b c = 0 ->
  exists u, u <> (0, 0) /\ dot u a = dot u b /\ dot u a = dot u c.
Proof.
  intros H. destruct (classic (a = b)) as [<- | D].
  - destruct (classic (a = c)) as [<- | D].
    + exists (1, 0). repeat split. intros E. injection E. lra.
    + exists (snd a - snd c, fst c - fst a). repeat split.
      * intros E. injection E as E F. apply D. destruct a, c. simpl in *. f_equal; lra.
      * unfold dot. simpl. ring.
  - exists (snd a - snd b, fst b - fst a). repeat split.
    + intros E. injection E as E F. apply D. destruct a, b. simpl in *. f_equal; lra.
    + unfold dot. simpl. ring.
    + unfold orient in H. unfold dot. simpl. lra.
Qed.

Lemma mixed_signs A B C a b c a' b' c' :
  inside a A -> inside b B -> inside c C -> inside a' A -> inside b' B -> inside c' C ->
  orient a b c <= 0 -> 0 <= orient a' b' c' ->
  exists x y z, inside x A /\ inside y B /\ inside z C /\ orient x y z = 0.
Proof.
  intros Ia Ib Ic Ia' Ib' Ic' L G.
  destruct (intermediate (fun t => orient (mix t a a') (mix t b b') (mix t c c'))) as [t [T E]].
  - unfold orient, mix. simpl. reg.
  - rewrite !mix_0. exact L.
  - rewrite !mix_1. exact G.
  - exists (mix t a a'), (mix t b b'), (mix t c c'). repeat split; try exact E; now apply inside_convex.
Qed.

(* Unsure means that a line meets all three. *)
Theorem unsure_iff_line A B C : (~ surely_left A B C /\ ~ surely_right A B C) <-> line_meets_all A B C.
Proof.
  split.
  - intros [NL NR].
    assert (L : exists a b c, inside a A /\ inside b B /\ inside c C /\ orient a b c <= 0).
    { apply NNPP. intros E. apply NL. intros a b c Ia Ib Ic. apply Rnot_le_lt. intros X. apply E. now exists a, b, c. }
    assert (G : exists a b c, inside a A /\ inside b B /\ inside c C /\ 0 <= orient a b c).
    { apply NNPP. intros E. apply NR. intros a b c Ia Ib Ic. apply Rnot_le_lt. intros X. apply E. now exists a, b, c. }
    destruct L as [a [b [c [Ia [Ib [Ic L]]]]]]. destruct G as [a' [b' [c' [Ia' [Ib' [Ic' G]]]]]].
    destruct (mixed_signs A B C a b c a' b' c' Ia Ib Ic Ia' Ib' Ic' L G) as [x [y [z [Ix [Iy [Iz E]]]]]].
    destruct (zero_orient_line x y z E) as [u [U [E1 E2]]].
    exists u, (dot u x). split; [exact U |]. split; [now exists x |]. split; [now exists y | now exists z].
  - intros [u [m [U [[a [Ia Ea]] [[b [Ib Eb]] [c [Ic Ec]]]]]]].
    assert (E : orient a b c = 0) by (apply (collinear u); congruence).
    split; intros H; pose proof (H a b c Ia Ib Ic); lra.
Qed.

(* The sign can only become surer. *)
Theorem surely_left_monotone A B C A' B' C' : refines A' A -> refines B' B -> refines C' C ->
  surely_left A B C -> surely_left A' B' C'.
Proof. intros RA RB RC H a b c Ia Ib Ic. apply H; [now apply RA | now apply RB | now apply RC]. Qed.
