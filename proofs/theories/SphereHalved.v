(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The image of a place in the terms of src/sphere/nearest_filter.c: halved above and below, and turns of angles [FLT-SPH]. *)
From Coq Require Import Reals Lra Lia Psatz.
From Dyadel Require Import Plane Sphere.
Open Scope R_scope.

(* With sine and cosine of half the difference of longitudes, s and c, and of latitudes, v and w. *)
Theorem image_halved l0 f0 l f :
  let s := sin ((l - l0) / 2) in let c := cos ((l - l0) / 2) in
  let v := sin ((f - f0) / 2) in let w := cos ((f - f0) / 2) in
  let D := v * v + cos f0 * (cos f * (s * s)) in D <> 0 ->
  image (east l0) (north l0 f0) (place l0 f0) (place l f) =
    (cos f * (s * c) / D, (v * w + sin f0 * (cos f * (s * s))) / D).
Proof.
  intros s c v w D N. rewrite image_of_place. fold s v.
  assert (S : sin (l - l0) = 2 * (s * c)) by (unfold s, c; replace (l - l0) with (2 * ((l - l0) / 2)) at 1 by field;
    rewrite sin_2a; ring).
  assert (V : sin (2 * ((f - f0) / 2)) = 2 * (v * w)) by (unfold v, w; rewrite sin_2a; ring).
  rewrite S, V. replace (2 * (v * v) + 2 * cos f0 * cos f * (s * s)) with (2 * D) by (unfold D; ring).
  cbv zeta. f_equal; field; exact N.
Qed.

(* An angle that is k quarters of a turn more. *)
Theorem quarters k t :
  (sin (t + IZR (4 * k) * (PI / 2)) = sin t /\ cos (t + IZR (4 * k) * (PI / 2)) = cos t) /\
  (sin (t + IZR (4 * k + 1) * (PI / 2)) = cos t /\ cos (t + IZR (4 * k + 1) * (PI / 2)) = - sin t) /\
  (sin (t + IZR (4 * k + 2) * (PI / 2)) = - sin t /\ cos (t + IZR (4 * k + 2) * (PI / 2)) = - cos t) /\
  (sin (t + IZR (4 * k + 3) * (PI / 2)) = - cos t /\ cos (t + IZR (4 * k + 3) * (PI / 2)) = sin t).
Proof.
  assert (Whole : forall x, sin (x + IZR (4 * k) * (PI / 2)) = sin x /\ cos (x + IZR (4 * k) * (PI / 2)) = cos x).
  { intros x. assert (P : IZR (4 * k) * (PI / 2) = 2 * IZR k * PI) by (rewrite mult_IZR; field). rewrite P.
    destruct (Z_le_dec 0 k) as [K | K].
    - rewrite <- (Z2Nat.id k K), <- INR_IZR_INZ. split; [apply sin_period | apply cos_period].
    - set (y := x + 2 * IZR k * PI). assert (E : x = y + 2 * INR (Z.to_nat (- k)) * PI).
      { unfold y. rewrite INR_IZR_INZ, Z2Nat.id by lia. rewrite opp_IZR. ring. }
      rewrite E. split; symmetry; [apply sin_period | apply cos_period]. }
  assert (More : forall q : Z, t + IZR (4 * k + q) * (PI / 2) = t + IZR q * (PI / 2) + IZR (4 * k) * (PI / 2))
    by (intros q; rewrite plus_IZR; ring).
  assert (Turn : forall x, sin (x + PI / 2) = cos x /\ cos (x + PI / 2) = - sin x).
  { intros x. rewrite sin_plus, cos_plus, sin_PI2, cos_PI2. split; ring. }
  rewrite !More. replace (t + IZR 1 * (PI / 2)) with (t + PI / 2) by lra.
  replace (t + IZR 2 * (PI / 2)) with (t + PI / 2 + PI / 2) by lra.
  replace (t + IZR 3 * (PI / 2)) with (t + PI / 2 + PI / 2 + PI / 2) by lra.
  destruct (Whole t) as [A B]. destruct (Whole (t + PI / 2)) as [C D]. destruct (Whole (t + PI / 2 + PI / 2)) as [E F].
  destruct (Whole (t + PI / 2 + PI / 2 + PI / 2)) as [G H]. rewrite A, B, C, D, E, F, G, H.
  destruct (Turn t) as [T T']. destruct (Turn (t + PI / 2)) as [U U']. destruct (Turn (t + PI / 2 + PI / 2)) as [V V'].
  rewrite V, V', U, U', T, T'. repeat split; ring.
Qed.

(* Between the ends of an interval sine and cosine change by its width at most. *)
Theorem turn_width a b : Rabs (sin a - sin b) <= Rabs (a - b) /\ Rabs (cos a - cos b) <= Rabs (a - b).
Proof.
  assert (Small : forall x, Rabs (sin x) <= Rabs x).
  { assert (Up : forall x, 0 <= x -> Rabs (sin x) <= x).
    { intros x X. destruct (Rle_or_lt x 1) as [L | L].
      - pose proof PI2_1. rewrite Rabs_right by (apply Rle_ge, sin_ge_0; lra).
        destruct (Rle_lt_or_eq_dec 0 x X) as [P | <-]; [left; now apply sin_lt_x | rewrite sin_0; lra].
      - apply Rle_trans with 1; [apply Rabs_le, SIN_bound | lra]. }
    intros x. destruct (Rle_or_lt 0 x) as [X | X]; [rewrite (Rabs_right x) by lra; now apply Up |].
    rewrite (Rabs_left x X), <- (Rabs_Ropp (sin x)), <- sin_neg. apply Up. lra. }
  assert (H : forall x y, -1 <= y <= 1 -> Rabs (2 * y * sin (x / 2)) <= Rabs x).
  { intros x y Y. rewrite !Rabs_mult, (Rabs_right 2) by lra. pose proof (Small (x / 2)) as S. unfold Rdiv in S at 2.
    rewrite Rabs_mult, (Rabs_right (/ 2)) in S by lra. pose proof (Rabs_le y 1 ltac:(lra)). pose proof (Rabs_pos y).
    pose proof (Rabs_pos (sin (x / 2))). nra. }
  split; [rewrite form4; apply H, COS_bound |].
  rewrite form2. replace (-2 * sin ((a - b) / 2) * sin ((a + b) / 2)) with (2 * - sin ((a + b) / 2) * sin ((a - b) / 2)) by
    ring. apply H. pose proof (SIN_bound ((a + b) / 2)). lra.
Qed.
