(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Delaunay edges do not cross legal ones, and what the quad rule excludes never happens in a flip. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc PartialDisc.
Open Scope R_scope.

(* An empty disc or half-plane with p i and p j on its boundary, as one inequality: g >= 0 at all points, g = 0 at the
   two, where g (x,y) = a (x^2 + y^2) + b x + c y + d with a >= 0. *)
Record conic : Type := Conic { ca : R; cb : R; cc : R; cd : R }.
Definition value (g : conic) (z : point) : R := ca g * dot z z + cb g * fst z + cc g * snd z + cd g.
Definition supports (N : nat) (p : nat -> point) (i j : nat) (g : conic) : Prop :=
  0 <= ca g /\ (ca g <> 0 \/ cb g <> 0 \/ cc g <> 0) /\
  value g (p i) = 0 /\ value g (p j) = 0 /\ forall k, (k < N)%nat -> 0 <= value g (p k).

Lemma disc_value c r z : value (Conic 1 (-2 * fst c) (-2 * snd c) (dot c c - r * r)) z = dist2 c z - r * r.
Proof. unfold value, dist2, dot. simpl. ring. Qed.

Lemma weak_edge_supported N p i j : (i < N)%nat -> (j < N)%nat -> weak_edge N p i j -> exists g, supports N p i j g.
Proof.
  intros I J [[c [r [R0 [On Out]]]] | [u [m [U [On Out]]]]].
  - exists (Conic 1 (-2 * fst c) (-2 * snd c) (dot c c - r * r)). unfold supports. rewrite !disc_value.
    split; [simpl; lra |]. split; [left; simpl; lra |].
    pose proof (On i I (or_introl eq_refl)) as A. pose proof (On j J (or_intror eq_refl)) as D.
    split; [rewrite <- dist_sq, A; ring |]. split; [rewrite <- dist_sq, D; ring |].
    intros k K. rewrite disc_value, <- dist_sq. pose proof (Out k K). nra.
  - exists (Conic 0 (- fst u) (- snd u) m). unfold supports, value, dot in *. simpl.
    split; [lra |]. split.
    { right. apply NNPP. intros H. apply U. destruct u. simpl in *.
      apply not_or_and in H as [H G]. apply NNPP in H, G. f_equal; lra. }
    pose proof (On i I (or_introl eq_refl)). pose proof (On j J (or_intror eq_refl)).
    split; [lra |]. split; [lra |]. intros k K. pose proof (Out k K). lra.
Qed.

(* What a supported pair's disc or half-plane and another circle differ by is affine. *)
Lemma value_power_affine g o r t a b :
  ca g * power o r (mix t a b) - value g (mix t a b) =
  (1 - t) * (ca g * power o r a - value g a) + t * (ca g * power o r b - value g b).
Proof. unfold power, value, dist2, dot, mix. simpl. ring. Qed.

(* Where the segment ab of a supported pair meets a chord ij of a circle, a and b not inside of it, one of them outside:
   then ab is supported by a half-plane only, and the place where they meet is on its boundary line. *)
Lemma meeting_chord N p i j a b s t o r : (i < N)%nat -> (j < N)%nat -> dist o (p i) = r -> dist o (p j) = r ->
  0 < (1 - t) * power o r (p a) + t * power o r (p b) -> 0 <= s <= 1 -> mix s (p i) (p j) = mix t (p a) (p b) ->
  forall g, supports N p a b g -> ca g = 0 /\ (1 - s) * value g (p i) + s * value g (p j) = 0.
Proof.
  intros I J Ei Ej Pos S Z g [G0 [G1 [Va [Vb Vk]]]]. apply power_zero in Ei, Ej.
  pose proof (Vk i I) as Vi. pose proof (Vk j J) as Vj.
  pose proof (value_power_affine g o r s (p i) (p j)) as E.
  pose proof (value_power_affine g o r t (p a) (p b)) as E'. rewrite <- Z in E'.
  rewrite Ei, Ej in E. rewrite Va, Vb in E'.
  assert (0 <= (1 - s) * value g (p i)) by (apply Rmult_le_pos; lra).
  assert (0 <= s * value g (p j)) by (apply Rmult_le_pos; lra).
  assert (C0 : ca g = 0).
  { destruct (Req_dec (ca g) 0) as [Z0 | Z0]; [exact Z0 | exfalso].
    assert (0 < ca g * ((1 - t) * power o r (p a) + t * power o r (p b))) by (apply Rmult_lt_0_compat; lra). lra. }
  split; [exact C0 |]. rewrite C0 in *. lra.
Qed.

(* If the segments of a strictly Delaunay pair ij and of a Delaunay pair ab meet (no common sites), it is so. *)
Lemma meeting_edges N p i j a b s t :
  (i < N)%nat -> (j < N)%nat -> (a < N)%nat -> (b < N)%nat -> a <> i -> a <> j -> b <> i -> b <> j ->
  strict_edge N p i j -> 0 <= s <= 1 -> 0 <= t <= 1 -> mix s (p i) (p j) = mix t (p a) (p b) ->
  forall g, supports N p a b g -> ca g = 0 /\ (1 - s) * value g (p i) + s * value g (p j) = 0.
Proof.
  intros I J A B Dai Daj Dbi Dbj [o [Eq Out]] S T Z. apply (meeting_chord N p i j a b s t o (dist o (p i)) I J); auto.
  assert (Ha : 0 < power o (dist o (p i)) (p a)) by (apply power_gt; [apply dist_nonneg | now apply Out]).
  assert (Hb : 0 < power o (dist o (p i)) (p b)) by (apply power_gt; [apply dist_nonneg | now apply Out]).
  set (u := power o (dist o (p i)) (p a)) in *. set (v := power o (dist o (p i)) (p b)) in *.
  destruct (Req_dec t 0) as [-> | T0]; [lra |]. assert (0 < t * v) by (apply Rmult_lt_0_compat; lra).
  assert (0 <= (1 - t) * u) by (apply Rmult_le_pos; lra). lra.
Qed.

Definition disc_edge (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  exists c r, 0 < r /\ empty_disc N p (pair i j) c r.

(* An edge with an empty disc never meets a strictly Delaunay edge of the same choice. *)
Theorem edges_do_not_cross N p i j a b z :
  (i < N)%nat -> (j < N)%nat -> (a < N)%nat -> (b < N)%nat -> a <> i -> a <> j -> b <> i -> b <> j ->
  strict_edge N p i j -> disc_edge N p a b -> between z (p i) (p j) -> ~ between z (p a) (p b).
Proof.
  intros I J A B Dai Daj Dbi Dbj H [c [r [R0 [On Out]]]] [s [S Zs]] [t [T Zt]].
  assert (Z : mix s (p i) (p j) = mix t (p a) (p b)) by congruence.
  pose proof (meeting_edges N p i j a b s t I J A B Dai Daj Dbi Dbj H S T Z
    (Conic 1 (-2 * fst c) (-2 * snd c) (dot c c - r * r))) as M.
  destruct M as [M _]; [| simpl in M; lra].
  unfold supports. rewrite !disc_value. pose proof (On a A (or_introl eq_refl)) as Ea.
  pose proof (On b B (or_intror eq_refl)) as Eb.
  split; [simpl; lra |]. split; [left; simpl; lra |].
  split; [rewrite <- dist_sq, Ea; ring |]. split; [rewrite <- dist_sq, Eb; ring |].
  intros k K. rewrite disc_value, <- dist_sq. pose proof (Out k K). nra.
Qed.

(* So a pair that crosses a legal edge for some choice is not an edge of that choice. *)
Corollary legal_edges_are_not_crossed N B p i j a b z :
  (i < N)%nat -> (j < N)%nat -> (a < N)%nat -> (b < N)%nat -> a <> i -> a <> j -> b <> i -> b <> j ->
  legal N B i j -> choice N B p -> between z (p i) (p j) -> between z (p a) (p b) -> ~ disc_edge N p a b.
Proof.
  intros I J A H Dai Daj Dbi Dbj L P Zi Za E.
  exact (edges_do_not_cross N p i j a b z I J A H Dai Daj Dbi Dbj (legal_sound N B i j p I J L P) E Zi Za).
Qed.

(* Ed: the partial edge of two rectangles, the convex hull of their union. *)
Definition partial_edge (X Y : rect) (z : point) : Prop :=
  exists x y, inside x X /\ inside y Y /\ between z x y.

(* What the quad rule excludes: with it, the pair ab cannot displace the pair ij. *)
Definition cannot_displace (B : sites) (i j a b : nat) : Prop :=
  (forall z, partial_edge (B i) (B j) z -> ~ partial_edge (B a) (B b) z) \/
  (forall w, inside w (B a) -> out_of_all (B i) (B j) (B b) w) \/
  (forall w, inside w (B b) -> out_of_all (B i) (B j) (B a) w).

(* A flip: the four points are on one circle, and the segments meet. *)
Definition flips (p : nat -> point) (i j a b : nat) : Prop :=
  (exists o r, circle o r (p i) (p j) (p a) /\ dist o (p b) = r) /\
  exists z, between z (p i) (p j) /\ between z (p a) (p b).

Theorem quad_rule_sound N B p i j a b :
  (i < N)%nat -> (j < N)%nat -> (a < N)%nat -> (b < N)%nat -> choice N B p ->
  cannot_displace B i j a b -> ~ flips p i j a b.
Proof.
  intros I J A H P Q [[o [r [[Ei [Ej Ea]] Eb]]] [z [Zi Za]]]. destruct Q as [Q | [Q | Q]].
  - apply (Q z).
    + exists (p i), (p j). split; [now apply P |]. split; [now apply P | exact Zi].
    + exists (p a), (p b). split; [now apply P |]. split; [now apply P | exact Za].
  - pose proof (Q (p a) (P a A) (p i) (p j) (p b) o r (P i I) (P j J) (P b H) (conj Ei (conj Ej Eb))). lra.
  - pose proof (Q (p b) (P b H) (p i) (p j) (p a) o r (P i I) (P j J) (P a A) (conj Ei (conj Ej Ea))). lra.
Qed.
