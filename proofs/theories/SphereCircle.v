(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Four points on one circle of the sphere: a sum of determinants, and its value in longitudes and latitudes [SPH-3]. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Sphere.
Open Scope R_scope.

Definition across (u v : space) : space :=
  Space (sy u * sz v - sz u * sy v) (sz u * sx v - sx u * sz v) (sx u * sy v - sy u * sx v).
Definition det (u v w : space) : R := inner (across u v) w.

(* The sum that is 0 for four points on one circle. *)
Definition coplanar_sum (a b c d : space) : R := det b c d - det a c d + det a b d - det a b c.

Lemma coplanar_differences a b c d : coplanar_sum a b c d = det (minus b a) (minus c a) (minus d a).
Proof. unfold coplanar_sum, det, inner, across, minus. simpl. ring. Qed.

Lemma nonzero h : h <> Space 0 0 0 -> 0 < inner h h.
Proof.
  intros H. pose proof (inner_nonneg h). destruct (Req_dec (inner h h) 0) as [Z | Z]; [elim H;
    now apply inner_zero | lra].
Qed.

(* A vector across three others, other than 0: their determinant is 0. *)
Lemma across_three h u v w : 0 < inner h h -> inner h u = 0 -> inner h v = 0 -> inner h w = 0 -> det u v w = 0.
Proof.
  intros P U V W.
  assert (X : inner h h * det u v w = inner h u * inner (across v w) h + inner h v * inner (across w u) h +
    inner h w * inner (across u v) h) by (unfold det, inner, across; simpl; ring).
  rewrite U, V, W in X. apply (Rmult_eq_reg_l (inner h h)); lra.
Qed.

(* A multiple of u is across whatever u is across. *)
Lemma parallel_across h u v : 0 < inner u u -> across u v = Space 0 0 0 -> inner h u = 0 -> inner h v = 0.
Proof.
  intros P E H. assert (X : inner u u * inner h v = inner u v * inner h u + inner h (across (across u v) u))
    by (unfold inner, across; simpl; ring).
  rewrite E, H in X. assert (Z : inner h (across (Space 0 0 0) u) = 0) by (unfold inner, across; simpl; ring).
  rewrite Z in X. apply (Rmult_eq_reg_l (inner u u)); lra.
Qed.

Lemma some_across u : 0 < inner u u -> exists h, h <> Space 0 0 0 /\ inner h u = 0.
Proof.
  intros P. destruct u as [x y z]. unfold inner in *. simpl in *.
  destruct (Req_dec x 0) as [-> | X].
  - exists (Space 1 0 0). split; [intros E; injection E; lra | simpl; ring].
  - exists (Space (- y) x 0). split; [intros E; injection E; intros; lra | simpl; ring].
Qed.

Lemma det_zero_across u v w : 0 < inner u u -> det u v w = 0 ->
  exists h, h <> Space 0 0 0 /\ inner h u = 0 /\ inner h v = 0 /\ inner h w = 0.
Proof.
  intros P D. destruct (Req_dec (inner (across u v) (across u v)) 0) as [A | A].
  - apply inner_zero in A. destruct (Req_dec (inner (across u w) (across u w)) 0) as [C | C].
    + apply inner_zero in C. destruct (some_across u P) as [h [H E]]. exists h.
      split; [exact H |]. split; [exact E |]. split; now apply (parallel_across h u).
    + exists (across u w). split; [intros E; apply C; rewrite E; unfold inner; simpl; ring |].
      split; [unfold inner, across; simpl; ring |]. split; [| unfold inner, across; simpl; ring].
      transitivity (- det u v w); [unfold det, inner, across; simpl; ring | rewrite D; ring].
  - exists (across u v). split; [intros E; apply A; rewrite E; unfold inner; simpl; ring |].
    split; [unfold inner, across; simpl; ring |]. split; [unfold inner, across; simpl; ring | exact D].
Qed.

Theorem one_circle a b c d : on_sphere a -> on_sphere b -> a <> b ->
  ((exists h m, proper h m /\ inner h a = m /\ inner h b = m /\ inner h c = m /\ inner h d = m) <-> coplanar_sum a b c
    d = 0).
Proof.
  intros A B Dab. rewrite coplanar_differences.
  assert (Df : forall h x, inner h (minus x a) = inner h x - inner h a) by (intros; unfold inner, minus; simpl; ring).
  split.
  - intros (h & m & P & Ea & Eb & Ec & Ed). unfold proper in P. apply (across_three h); rewrite ?Df; try lra. nra.
  - intros Z. assert (P : 0 < inner (minus b a) (minus b a)).
    { apply nonzero. intros E. apply Dab. symmetry. apply minus_zero. rewrite E. unfold inner. simpl. ring. }
    destruct (det_zero_across _ _ _ P Z) as (h & H & U & V & W). rewrite Df in U, V, W.
    exists h, (inner h a). split; [apply (plane_is_proper h (inner h a) a b); auto; lra |]. repeat split; lra.
Qed.

(* ---- longitudes and latitudes ---- *)

Definition at_degrees (l f : R) : space := Space (cos f * cos l) (cos f * sin l) (sin f).

Theorem determinant_of_degrees l1 f1 l2 f2 l3 f3 :
  det (at_degrees l1 f1) (at_degrees l2 f2) (at_degrees l3 f3) =
  sin f3 * cos f1 * cos f2 * sin (l2 - l1) + sin f1 * cos f2 * cos f3 * sin (l3 - l2) + sin f2 * cos f3 * cos f1 * sin
    (l1 - l3).
Proof. rewrite !sin_minus. unfold det, inner, across, at_degrees. simpl. ring. Qed.

(* Four points of one parallel; two of one and two of another, with the same meridian half way. *)
Theorem one_parallel l1 l2 l3 l4 f :
  coplanar_sum (at_degrees l1 f) (at_degrees l2 f) (at_degrees l3 f) (at_degrees l4 f) = 0.
Proof. unfold coplanar_sum, det, inner, across, at_degrees. simpl. ring. Qed.

Theorem two_parallels m s t f g :
  coplanar_sum (at_degrees (m + s) f) (at_degrees (m - s) f) (at_degrees (m + t) g) (at_degrees (m - t) g) = 0.
Proof.
  unfold coplanar_sum, det, inner, across, at_degrees. simpl. rewrite !cos_plus, !sin_plus, !cos_minus, !sin_minus.
    ring.
Qed.
