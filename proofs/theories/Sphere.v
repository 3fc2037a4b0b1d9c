(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Points of the sphere, its circles, and the stereographic projection from a point q. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane.
Open Scope R_scope.

Record space : Type := Space { sx : R; sy : R; sz : R }.
Definition inner (v w : space) : R := sx v * sx w + sy v * sy w + sz v * sz w.
Definition on_sphere (v : space) : Prop := inner v v = 1.

(* A circle on the sphere is a plane h.x = m nearer to the centre than 1. A pair is Delaunay if both are on some circle
   with no site on one side, strictly if no further site is on it. *)
Definition proper (h : space) (m : R) : Prop := m * m < inner h h.
Definition sphere_edge (N : nat) (y : nat -> space) (i j : nat) : Prop := exists h m, proper h m /\
  inner h (y i) = m /\ inner h (y j) = m /\ forall k, (k < N)%nat -> inner h (y k) <= m.
Definition sphere_strict_edge (N : nat) (y : nat -> space) (i j : nat) : Prop := exists h m, proper h m /\
  inner h (y i) = m /\ inner h (y j) = m /\ forall k, (k < N)%nat -> k <> i -> k <> j -> inner h (y k) < m.
Definition sphere_triangle (N : nat) (y : nat -> space) (i j l : nat) : Prop := exists h m, proper h m /\
  inner h (y i) = m /\ inner h (y j) = m /\ inner h (y l) = m /\
  forall k, (k < N)%nat -> k <> i -> k <> j -> k <> l -> inner h (y k) < m.

(* Different points of the sphere, numbered. *)
Definition places (N : nat) (y : nat -> space) : Prop :=
  (forall k, (k < N)%nat -> on_sphere (y k)) /\
  forall k l, (k < N)%nat -> (l < N)%nat -> k <> l -> y k <> y l.

Definition minus (v w : space) : space := Space (sx v - sx w) (sy v - sy w) (sz v - sz w).

Lemma inner_sym v w : inner v w = inner w v.
Proof. unfold inner. ring. Qed.

Lemma inner_nonneg v : 0 <= inner v v.
Proof. unfold inner. nra. Qed.

Lemma inner_zero v : inner v v = 0 -> v = Space 0 0 0.
Proof. destruct v as [a b c]. unfold inner. simpl. intros H. f_equal; nra. Qed.

Lemma minus_sq v w : inner (minus v w) (minus v w) = inner v v + inner w w - 2 * inner v w.
Proof. unfold inner, minus. simpl. ring. Qed.

Lemma minus_zero v w : inner (minus v w) (minus v w) = 0 -> v = w.
Proof.
  intros H. apply inner_zero in H. destruct v, w. unfold minus in H. simpl in H. injection H as A B C. f_equal; lra.
Qed.

(* Different points of the sphere are less than 1 apart in their scalar product. *)
Lemma apart v w : on_sphere v -> on_sphere w -> v <> w -> inner v w < 1.
Proof.
  unfold on_sphere. intros V W D. pose proof (inner_nonneg (minus v w)) as P. pose proof (minus_sq v w) as E.
  destruct (Req_dec (inner (minus v w) (minus v w)) 0) as [Z | Z]; [elim D; now apply minus_zero | lra].
Qed.

(* A plane through two points of the sphere cuts it in a circle. *)
Lemma plane_is_proper h m v w : on_sphere v -> on_sphere w -> v <> w -> h <> Space 0 0 0 ->
  inner h v = m -> inner h w = m -> proper h m.
Proof.
  intros V W D H Ev Ew. pose proof (apart v w V W D) as A. unfold on_sphere in *.
  assert (P : 0 < inner h h).
  { pose proof (inner_nonneg h). destruct (Req_dec (inner h h) 0) as [Z | Z]; [elim H; now apply inner_zero | lra]. }
  set (s := Space (sx v + sx w) (sy v + sy w) (sz v + sz w)).
  assert (S : inner s s = 2 + 2 * inner v w).
  { transitivity (inner v v + inner w w + 2 * inner v w); [unfold inner, s; simpl; ring | lra]. }
  assert (T : inner h s = 2 * m).
  { transitivity (inner h v + inner h w); [unfold inner, s; simpl; ring | lra]. }
  assert (C : inner h s * inner h s <= inner h h * inner s s).
  { assert (E : inner h h * inner s s - inner h s * inner h s =
      (sx h * sy s - sy h * sx s) * (sx h * sy s - sy h * sx s) + (sy h * sz s - sz h * sy s) * (sy h * sz s - sz h * sy s)
      + (sz h * sx s - sx h * sz s) * (sz h * sx s - sx h * sz s)) by (unfold inner; ring).
    pose proof (Rle_0_sqr (sx h * sy s - sy h * sx s)). pose proof (Rle_0_sqr (sy h * sz s - sz h * sy s)).
    pose proof (Rle_0_sqr (sz h * sx s - sx h * sz s)). unfold Rsqr in *. lra. }
  rewrite S, T in C. unfold proper. nra.
Qed.

(* The volume that three vectors span, positive when right-handed. *)
Definition triple (u v w : space) : R :=
  sx u * (sy v * sz w - sz v * sy w) - sy u * (sx v * sz w - sz v * sx w) + sz u * (sx v * sy w - sy v * sx w).

Lemma triple_product a b c u v w : triple a b c * triple u v w =
  inner a u * (inner b v * inner c w - inner b w * inner c v) - inner a v * (inner b u * inner c w - inner b w * inner c u)
  + inner a w * (inner b u * inner c v - inner b v * inner c u).
Proof. unfold triple, inner. ring. Qed.

Lemma minus_inner a b c : inner (minus a b) c = inner a c - inner b c.
Proof. unfold inner, minus. simpl. ring. Qed.

(* Axes at q: east, north and q itself. *)
Record axes (e n q : space) : Prop := Axes {
  of_axes : forall v w, inner v w = inner v e * inner w e + inner v n * inner w n + inner v q * inner w q;
  unit_e : inner e e = 1; unit_n : inner n n = 1; unit_q : inner q q = 1;
  across_en : inner e n = 0; across_eq : inner e q = 0; across_nq : inner n q = 0 }.

(* The image on the plane through the centre of the sphere, seen from q. *)
Definition image (e n q v : space) : point := (inner v e / (1 - inner v q), inner v n / (1 - inner v q)).

(* Places by longitude and latitude, and the axes there. *)
Definition place (l f : R) : space := Space (cos f * cos l) (cos f * sin l) (sin f).
Definition east (l : R) : space := Space (- sin l) (cos l) 0.
Definition north (l f : R) : space := Space (- sin f * cos l) (- sin f * sin l) (cos f).

Lemma circle_of_angle a : cos a * cos a = 1 - sin a * sin a.
Proof. pose proof (sin2_cos2 a) as H. unfold Rsqr in H. lra. Qed.

Lemma place_on_sphere l f : on_sphere (place l f).
Proof.
  unfold on_sphere, inner, place. simpl. transitivity (cos f * cos f * (cos l * cos l) + cos f * cos f * (sin l * sin l)
    + sin f * sin f); [ring |]. rewrite !circle_of_angle. ring.
Qed.

Theorem place_axes l f : axes (east l) (north l f) (place l f).
Proof.
  pose proof (circle_of_angle l) as L. pose proof (circle_of_angle f) as F.
  split; try intros v w; unfold inner, east, north, place; simpl.
  - transitivity ((sx v * sx w) * (sin l * sin l + (sin f * sin f + cos f * cos f) * (cos l * cos l))
      + (sy v * sy w) * (cos l * cos l + (sin f * sin f + cos f * cos f) * (sin l * sin l))
      + (sz v * sz w) * (cos f * cos f + sin f * sin f)
      + (sx v * sy w + sy v * sx w) * (sin l * cos l) * (sin f * sin f + cos f * cos f - 1)).
    + rewrite L, F. ring.
    + ring.
  - transitivity (sin l * sin l + cos l * cos l); [ring | rewrite L; ring].
  - transitivity (sin f * sin f * (cos l * cos l + sin l * sin l) + cos f * cos f); [ring | rewrite L, F; ring].
  - transitivity (cos f * cos f * (cos l * cos l + sin l * sin l) + sin f * sin f); [ring | rewrite L, F; ring].
  - ring.
  - ring.
  - transitivity (sin f * cos f * (1 - (cos l * cos l + sin l * sin l))); [ring | rewrite L; ring].
Qed.

Theorem place_right_handed l f : triple (east l) (north l f) (place l f) = 1.
Proof.
  pose proof (circle_of_angle l) as L. pose proof (circle_of_angle f) as F. unfold triple, east, north, place. simpl.
  transitivity ((sin f * sin f + cos f * cos f) * (sin l * sin l + cos l * cos l)); [ring | rewrite L, F; ring].
Qed.

(* The image in the terms of the code [SPH-2]: (X,Y)/D. *)
Theorem image_of_place l0 f0 l f :
  let d := l - l0 in let h := sin (d / 2) * sin (d / 2) in
  let u := (f - f0) / 2 in
  image (east l0) (north l0 f0) (place l0 f0) (place l f) =
    let D := 2 * (sin u * sin u) + 2 * cos f0 * cos f * h in
    (cos f * sin d / D, (sin (2 * u) + 2 * sin f0 * cos f * h) / D).
Proof.
  intros d h u. set (D := 2 * (sin u * sin u) + 2 * cos f0 * cos f * h). cbv zeta.
  assert (Cd : cos d = 1 - 2 * h).
  { unfold h. replace d with (2 * (d / 2)) at 1 by field. rewrite cos_2a_sin. ring. }
  assert (Cu : cos (f - f0) = 1 - 2 * (sin u * sin u)).
  { replace (f - f0) with (2 * u) by (unfold u; field). rewrite cos_2a_sin. ring. }
  assert (Su : sin (2 * u) = sin (f - f0)) by (f_equal; unfold u; field).
  unfold image. f_equal.
  - f_equal.
    + unfold inner, place, east, d. simpl. rewrite sin_minus. ring.
    + f_equal. unfold D. transitivity (1 - (cos (f - f0) - 2 * cos f0 * cos f * h)); [| rewrite Cu; ring].
      f_equal. f_equal. transitivity (sin f * sin f0 + cos f * cos f0 * cos d).
      * unfold inner, place, d. simpl. rewrite cos_minus. ring.
      * rewrite Cd, cos_minus. ring.
  - f_equal.
    + rewrite Su. transitivity (sin f * cos f0 - cos f * sin f0 * cos d).
      * unfold inner, place, north, d. simpl. rewrite cos_minus. ring.
      * rewrite Cd, sin_minus. ring.
    + f_equal. unfold D. transitivity (1 - (cos (f - f0) - 2 * cos f0 * cos f * h)); [| rewrite Cu; ring].
      f_equal. f_equal. transitivity (sin f * sin f0 + cos f * cos f0 * cos d).
      * unfold inner, place, d. simpl. rewrite cos_minus. ring.
      * rewrite Cd, cos_minus. ring.
Qed.
