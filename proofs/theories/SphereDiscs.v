(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The image of all that is within an angle of a place is a disc, and what a function of three variables takes over a
   box [SPH-2]. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Sphere.
Open Scope R_scope.

(* v is within the angle a of w iff its image is in the disc. *)
Theorem cap_image e n q w v a : axes e n q -> on_sphere w -> on_sphere v -> inner v q < 1 -> 0 <= sin a ->
  let E := cos a - inner w q in 0 < E ->
  (cos a <= inner v w <-> dist (image e n q v) (inner w e / E, inner w n / E) <= sin a / E).
Proof.
  intros Ax W V Q Sa E E0. pose proof (of_axes e n q Ax v w) as Evw. pose proof (of_axes e n q Ax v v) as Evv.
  pose proof (of_axes e n q Ax w w) as Eww. unfold on_sphere in W, V. rewrite V in Evv. rewrite W in Eww.
  set (C := (inner w e / E, inner w n / E)). set (d := 1 - inner v q). assert (D : 0 < d) by (unfold d; lra).
  assert (R0 : 0 <= sin a / E) by (apply Rle_mult_inv_pos; assumption).
  assert (Key : d * E * (dist2 (image e n q v) C - sin a / E * (sin a / E)) = 2 * (cos a - inner v w)).
  { pose proof (circle_of_angle a) as Ca. unfold C, dist2, image. simpl. fold d.
    set (x := inner v e) in *. set (y := inner v n) in *. set (z := inner v q) in *.
    set (X := inner w e) in *. set (Y := inner w n) in *. set (Z := inner w q) in *.
    apply (Rmult_eq_reg_l (d * E)); [| apply Rmult_integral_contrapositive; lra].
    transitivity ((x * x + y * y) * (E * E) - 2 * (d * E) * (x * X + y * Y) + d * d * (X * X + Y * Y - sin a * sin a)).
    { field. lra. }
    replace (x * x + y * y) with (d * (1 + z)) by (replace (x * x + y * y) with (1 - z * z) by lra; unfold d; ring).
    replace (X * X + Y * Y - sin a * sin a) with (E * (cos a + Z))
      by (replace (X * X + Y * Y) with (1 - Z * Z) by lra; replace (sin a * sin a) with (1 - cos a * cos a) by lra;
        unfold E; ring).
    rewrite Evw. unfold d, E. ring. }
  assert (DE : 0 < d * E) by now apply Rmult_lt_0_compat. split; intros H.
  - apply le_of_squares; [exact R0 |]. rewrite dist_sq. apply Rnot_lt_le. intros L.
    assert (0 < d * E * (dist2 (image e n q v) C - sin a / E * (sin a / E))) by (apply Rmult_lt_0_compat; lra). lra.
  - assert (L : dist2 (image e n q v) C <= sin a / E * (sin a / E)).
    { rewrite <- dist_sq. apply Rmult_le_compat; auto using dist_nonneg. }
    assert (0 <= d * E * (sin a / E * (sin a / E) - dist2 (image e n q v) C)) by (apply Rmult_le_pos; lra). lra.
Qed.

(* The same in the terms of the code: centre (X,Y)/E, radius sin a / E, E = D - 2 sin^2(a/2). *)
Theorem cap_of_place l0 f0 l f v a : on_sphere v -> inner v (place l0 f0) < 1 -> 0 <= sin a ->
  let d := l - l0 in let h := sin (d / 2) * sin (d / 2) in let u := (f - f0) / 2 in
  let D := 2 * (sin u * sin u) + 2 * cos f0 * cos f * h in
  let E := D - 2 * (sin (a / 2) * sin (a / 2)) in 0 < E ->
  (cos a <= inner v (place l f) <->
    dist (image (east l0) (north l0 f0) (place l0 f0) v)
      (cos f * sin d / E, (sin (2 * u) + 2 * sin f0 * cos f * h) / E) <= sin a / E).
Proof.
  intros V Q Sa d h u D E E0.
  assert (Cd : cos d = 1 - 2 * h).
  { unfold h. replace d with (2 * (d / 2)) at 1 by field. rewrite cos_2a_sin. ring. }
  assert (Cu : cos (f - f0) = 1 - 2 * (sin u * sin u)).
  { replace (f - f0) with (2 * u) by (unfold u; field). rewrite cos_2a_sin. ring. }
  assert (Su : sin (2 * u) = sin (f - f0)) by (f_equal; unfold u; field).
  assert (Ca : cos a = 1 - 2 * (sin (a / 2) * sin (a / 2))).
  { replace a with (2 * (a / 2)) at 1 by field. rewrite cos_2a_sin. ring. }
  assert (Iq : inner (place l f) (place l0 f0) = 1 - D).
  { transitivity (cos (f - f0) - 2 * cos f0 * cos f * h); [| rewrite Cu; unfold D; ring].
    transitivity (sin f * sin f0 + cos f * cos f0 * cos d).
    - unfold inner, place, d. simpl. rewrite cos_minus. ring.
    - rewrite Cd, cos_minus. ring. }
  assert (Ie : inner (place l f) (east l0) = cos f * sin d).
  { unfold inner, place, east, d. simpl. rewrite sin_minus. ring. }
  assert (In' : inner (place l f) (north l0 f0) = sin (2 * u) + 2 * sin f0 * cos f * h).
  { rewrite Su. transitivity (sin f * cos f0 - cos f * sin f0 * cos d).
    - unfold inner, place, north, d. simpl. rewrite cos_minus. ring.
    - rewrite Cd, sin_minus. ring. }
  assert (Ee : E = cos a - inner (place l f) (place l0 f0)) by (rewrite Iq, Ca; unfold E; ring).
  pose proof (cap_image (east l0) (north l0 f0) (place l0 f0) (place l f) v a (place_axes l0 f0) (place_on_sphere l f)
    V Q Sa) as K. cbv zeta in K. rewrite <- Ee, Ie, In' in K. now apply K.
Qed.

(* From the middle of a box a function of three variables changes by no more than its derivatives, anywhere in the box,
   times the half sides. *)
Theorem mean_value_form (F F1 F2 F3 : R -> R -> R -> R) m1 m2 m3 x1 x2 x3 h1 h2 h3 b1 b2 b3 :
  let at1 t := m1 + t * (x1 - m1) in let at2 t := m2 + t * (x2 - m2) in let at3 t := m3 + t * (x3 - m3) in
  Rabs (x1 - m1) <= h1 -> Rabs (x2 - m2) <= h2 -> Rabs (x3 - m3) <= h3 ->
  (forall t, 0 <= t <= 1 -> derivable_pt_lim (fun t => F (at1 t) (at2 t) (at3 t)) t
    (F1 (at1 t) (at2 t) (at3 t) * (x1 - m1) + F2 (at1 t) (at2 t) (at3 t) * (x2 - m2) +
     F3 (at1 t) (at2 t) (at3 t) * (x3 - m3))) ->
  (forall y1 y2 y3, Rabs (y1 - m1) <= h1 -> Rabs (y2 - m2) <= h2 -> Rabs (y3 - m3) <= h3 ->
    Rabs (F1 y1 y2 y3) <= b1 /\ Rabs (F2 y1 y2 y3) <= b2 /\ Rabs (F3 y1 y2 y3) <= b3) ->
  Rabs (F x1 x2 x3 - F m1 m2 m3) <= b1 * h1 + b2 * h2 + b3 * h3.
Proof.
  intros at1 at2 at3 H1 H2 H3 De Bd.
  destruct (MVT_cor2 (fun t => F (at1 t) (at2 t) (at3 t)) (fun t => F1 (at1 t) (at2 t) (at3 t) * (x1 - m1) +
    F2 (at1 t) (at2 t) (at3 t) * (x2 - m2) + F3 (at1 t) (at2 t) (at3 t) * (x3 - m3)) 0 1 Rlt_0_1 De) as (t & Eq & T).
  assert (Way : forall m x h, Rabs (x - m) <= h -> Rabs (m + t * (x - m) - m) <= h).
  { intros m x h H. replace (m + t * (x - m) - m) with (t * (x - m)) by ring. rewrite Rabs_mult, (Rabs_pos_eq t) by lra.
    pose proof (Rabs_pos (x - m)). assert (t * Rabs (x - m) <= 1 * Rabs (x - m)) by (apply Rmult_le_compat_r; lra).
    lra. }
  destruct (Bd (at1 t) (at2 t) (at3 t)) as (B1 & B2 & B3); [now apply Way | now apply Way | now apply Way |].
  assert (E0 : at1 0 = m1 /\ at2 0 = m2 /\ at3 0 = m3) by (unfold at1, at2, at3; repeat split; ring).
  assert (E1 : at1 1 = x1 /\ at2 1 = x2 /\ at3 1 = x3) by (unfold at1, at2, at3; repeat split; ring).
  cbv beta in Eq. destruct E0 as (A1 & A2 & A3). rewrite A1, A2, A3 in Eq. clear A1 A2 A3.
  destruct E1 as (A1 & A2 & A3).
  rewrite A1, A2, A3 in Eq. rewrite Eq, Rminus_0_r, Rmult_1_r.
  assert (Prod : forall u b w h, Rabs u <= b -> Rabs w <= h -> Rabs (u * w) <= b * h).
  { intros u b w h U W. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
  pose proof (Prod _ _ _ _ B1 H1) as P1. pose proof (Prod _ _ _ _ B2 H2) as P2. pose proof (Prod _ _ _ _ B3 H3) as P3.
  revert P1 P2 P3. generalize (F1 (at1 t) (at2 t) (at3 t) * (x1 - m1)) (F2 (at1 t) (at2 t) (at3 t) * (x2 - m2))
    (F3 (at1 t) (at2 t) (at3 t) * (x3 - m3)). intros p q r P1 P2 P3.
  pose proof (Rabs_triang (p + q) r). pose proof (Rabs_triang p q). lra.
Qed.
