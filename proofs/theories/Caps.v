(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Circles through the origin and discs: after inversion a line and discs, by directions and heights [DISC-1]. *)
From Coq Require Import Reals Lra Lia Psatz.
From Dyadel Require Import Plane.
Open Scope R_scope.

Definition o : point := (0, 0).
(* The circle about c through the origin becomes the line u.x = h, u the direction of c, h = 1 / (2 |c|); the disc about x
   with radius r, the origin outside of it, becomes that about x / n with radius r / n, n = |x|^2 - r^2. *)
Definition height (c : point) : R := / (2 * dist o c).
Definition size2 (x : point) (r : R) : R := dist2 o x - r * r.
Definition along (c x : point) (r : R) : R := dot c x / dist o c / size2 x r.
Definition image_radius (x : point) (r : R) : R := r / size2 x r.

Lemma dot_le c x : dot c x <= dist o c * dist o x.
Proof.
  pose proof (dist_nonneg o c). pose proof (dist_nonneg o x). apply le_of_squares; [now apply Rmult_le_pos |].
  replace (dist o c * dist o x * (dist o c * dist o x)) with ((dist o c * dist o c) * (dist o x * dist o x)) by ring.
  rewrite !dist_sq. unfold dist2, dot, o. simpl. pose proof (Rle_0_sqr (fst c * snd x - snd c * fst x)) as S. unfold Rsqr in S. nra.
Qed.

(* By squares; sign 1 for discs outside, -1 for those inside. *)
Lemma heights c x r s : 0 < dist o c -> 0 < size2 x r ->
  (along c x r + s * image_radius x r < height c <-> 2 * dot c x + s * (2 * r * dist o c) < size2 x r) /\
  (along c x r + s * image_radius x r = height c <-> 2 * dot c x + s * (2 * r * dist o c) = size2 x r).
Proof.
  intros P Q. unfold along, image_radius, height. set (l := dist o c) in *. set (n := size2 x r) in *. clearbody l n.
  assert (I : 0 < / (2 * l * n)) by (apply Rinv_0_lt_compat; nra).
  replace (dot c x / l / n + s * (r / n)) with ((2 * dot c x + s * (2 * r * l)) * / (2 * l * n)) by (field; lra).
  replace (/ (2 * l)) with (n * / (2 * l * n)) by (field; lra). split; split; intros H.
  - exact (Rmult_lt_reg_r _ _ _ I H).
  - now apply Rmult_lt_compat_r.
  - apply (Rmult_eq_reg_r (/ (2 * l * n))); lra.
  - now rewrite H.
Qed.

Lemma square_of_distance c x r : dist c x * dist c x = dist o c * dist o c + size2 x r + r * r - 2 * dot c x.
Proof. rewrite !dist_sq. unfold size2, dist2, dot, o. simpl. ring. Qed.

(* A disc outside of the circle, and one that touches it from outside. *)
Theorem disc_outside c x r : 0 < dist o c -> 0 < size2 x r -> 0 <= r ->
  (dist o c + r < dist c x <-> along c x r + image_radius x r < height c) /\
  (dist o c + r = dist c x <-> along c x r + image_radius x r = height c).
Proof.
  intros P Q S. destruct (heights c x r 1 P Q) as [H1 H2]. rewrite !Rmult_1_l in *. rewrite H1, H2.
  pose proof (square_of_distance c x r) as E. pose proof (dist_nonneg c x) as G.
  set (l := dist o c) in *. set (m := dist c x) in *. set (n := size2 x r) in *. clearbody l m n.
  split; split; intros H; nra.
Qed.

(* A disc not inside of the circle, touching it from inside at most, and one that does not touch it either. *)
Theorem disc_not_inside c x r : 0 < dist o c -> 0 < size2 x r -> 0 <= r ->
  (dist o c < dist c x + r <-> along c x r - image_radius x r < height c) /\
  (dist o c = dist c x + r <-> along c x r - image_radius x r = height c).
Proof.
  intros P Q S. destruct (heights c x r (-1) P Q) as [H1 H2].
  replace (along c x r + -1 * image_radius x r) with (along c x r - image_radius x r) in H1, H2 by ring. rewrite H1, H2.
  pose proof (square_of_distance c x r) as E. pose proof (dist_nonneg c x) as G. pose proof (dot_le c x) as K.
  pose proof (dist_nonneg o x) as X. pose proof (dist_sq o x) as Y.
  assert (Z : dist2 o x = size2 x r + r * r) by (unfold size2; ring). rewrite Z in Y.
  set (l := dist o c) in *. set (m := dist c x) in *. set (n := size2 x r) in *. set (w := dist o x) in *. clearbody l m n w.
  assert (W : r < w) by (apply Rnot_le_lt; intros L; nra).
  assert (D : n = (w - r) * (w + r)) by lra.
  assert (F : l <= r -> 2 * dot c x + -1 * (2 * r * l) < n).
  { intros L. apply Rle_lt_trans with ((w - r) * (2 * l)); [lra |]. rewrite D. apply Rmult_lt_compat_l; lra. }
  destruct (Rle_lt_dec l r) as [L | L].
  - pose proof (F L) as F'. split; split; intros H; try lra.
    + apply Rnot_le_lt. intros M. assert (m = 0) by lra. assert (l = r) by lra. subst. lra.
    + exfalso. assert (m = 0) by lra. assert (l = r) by lra. subst. lra.
  - split; split; intros H; nra.
Qed.
