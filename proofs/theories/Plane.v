(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Points of the plane: Euclidean distance, segments, half-planes of points nearer to one of two points. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Definition point : Type := (R * R)%type.

(* Square of the distance of two points, and the distance. *)
Definition dist2 (a b : point) : R :=
  (fst a - fst b) * (fst a - fst b) + (snd a - snd b) * (snd a - snd b).
Definition dist (a b : point) : R := sqrt (dist2 a b).

(* The point that divides the segment ab in the ratio t : 1 - t; 0 <= t <= 1 gives the points of the segment. *)
Definition mix (t : R) (a b : point) : point :=
  ((1 - t) * fst a + t * fst b, (1 - t) * snd a + t * snd b).

Definition between (z a b : point) : Prop := exists t, 0 <= t <= 1 /\ z = mix t a b.

(* Scalar product. *)
Definition dot (a b : point) : R := fst a * fst b + snd a * snd b.

Lemma dist2_nonneg a b : 0 <= dist2 a b.
Proof.
  unfold dist2. pose proof (Rle_0_sqr (fst a - fst b)) as A. pose proof (Rle_0_sqr (snd a - snd b)) as B.
  unfold Rsqr in A, B. lra.
Qed.

Lemma dist_nonneg a b : 0 <= dist a b.
Proof. apply sqrt_pos. Qed.

Lemma dist_sq a b : dist a b * dist a b = dist2 a b.
Proof. apply sqrt_sqrt, dist2_nonneg. Qed.

Lemma dist_sym a b : dist a b = dist b a.
Proof. unfold dist, dist2. f_equal. ring. Qed.

Lemma dist_self a : dist a a = 0.
Proof. unfold dist, dist2. replace (_ + _) with 0 by ring. apply sqrt_0. Qed.

Lemma dist_zero a b : dist a b = 0 -> a = b.
Proof.
  intros H. pose proof (dist_sq a b) as E. rewrite H in E. destruct a as [u v], b as [x y]. unfold dist2 in E.
  simpl in E. assert (A : Rsqr (u - x) + Rsqr (v - y) = 0) by (unfold Rsqr; lra).
  destruct (Rplus_sqr_eq_0 _ _ A) as [U V]. f_equal; lra.
Qed.

Lemma dist_pos a b : a <> b -> 0 < dist a b.
Proof.
  intros H. destruct (Rle_lt_or_eq_dec 0 (dist a b) (dist_nonneg a b)) as [G | G]; [exact G |].
  exfalso. apply H, dist_zero. lra.
Qed.

(* Distances are compared through their squares. *)
Lemma dist_le a b c d : dist a b <= dist c d <-> dist2 a b <= dist2 c d.
Proof.
  split; intros H.
  - rewrite <- !dist_sq. pose proof (dist_nonneg a b). nra.
  - apply sqrt_le_1_alt, H.
Qed.

Lemma dist_lt a b c d : dist a b < dist c d <-> dist2 a b < dist2 c d.
Proof.
  split; intros H.
  - rewrite <- !dist_sq. pose proof (dist_nonneg a b). nra.
  - apply sqrt_lt_1_alt. split; [apply dist2_nonneg | exact H].
Qed.

Lemma dist_eq a b c d : dist a b = dist c d <-> dist2 a b = dist2 c d.
Proof.
  split; intros H.
  - rewrite <- !dist_sq, H. reflexivity.
  - unfold dist. now rewrite H.
Qed.

Lemma le_of_squares x y : 0 <= y -> x * x <= y * y -> x <= y.
Proof. intros. nra. Qed.

Theorem dist_triangle a b c : dist a c <= dist a b + dist b c.
Proof.
  pose proof (dist_nonneg a b) as P. pose proof (dist_nonneg b c) as Q. pose proof (dist_nonneg a c).
  apply le_of_squares; [lra |].
  pose (d := (fst a - fst b) * (fst b - fst c) + (snd a - snd b) * (snd b - snd c)).
  assert (K : d <= dist a b * dist b c).
  { apply le_of_squares; [nra |].
    replace (dist a b * dist b c * (dist a b * dist b c))
      with ((dist a b * dist a b) * (dist b c * dist b c)) by ring.
    rewrite !dist_sq. unfold dist2, d.
    set (p := fst a - fst b). set (q := snd a - snd b). set (r := fst b - fst c). set (s := snd b - snd c).
    pose proof (Rle_0_sqr (p * s - q * r)) as X. unfold Rsqr in X. nra. }
  replace ((dist a b + dist b c) * (dist a b + dist b c))
    with (dist a b * dist a b + dist b c * dist b c + 2 * (dist a b * dist b c)) by ring.
  rewrite !dist_sq. unfold dist2, d in *. nra.
Qed.

Lemma dist_triangle_rev a b c : dist a b - dist b c <= dist a c.
Proof. pose proof (dist_triangle a c b). rewrite (dist_sym c b) in H. lra. Qed.

Lemma mix_0 a b : mix 0 a b = a.
Proof. destruct a, b. unfold mix. simpl. f_equal; ring. Qed.

Lemma mix_1 a b : mix 1 a b = b.
Proof. destruct a, b. unfold mix. simpl. f_equal; ring. Qed.

Lemma mix_swap t a b : mix t a b = mix (1 - t) b a.
Proof. unfold mix. simpl. f_equal; ring. Qed.

Lemma dist_scaled x y a z b : dist2 x y = a * a * dist2 z b -> 0 <= a -> dist x y = a * dist z b.
Proof.
  intros E H. unfold dist. rewrite E, sqrt_mult; [| nra | apply dist2_nonneg].
  now rewrite sqrt_square.
Qed.

Lemma dist_mix_mix s t a b : dist (mix s a b) (mix t a b) = Rabs (s - t) * dist a b.
Proof.
  unfold dist. replace (dist2 (mix s a b) (mix t a b)) with (Rsqr (s - t) * dist2 a b).
  - rewrite sqrt_mult; [| apply Rle_0_sqr | apply dist2_nonneg]. now rewrite sqrt_Rsqr_abs.
  - unfold dist2, mix, Rsqr. simpl. ring.
Qed.

Lemma dist_mix_left t a b : 0 <= t -> dist a (mix t a b) = t * dist a b.
Proof.
  intros. rewrite <- (mix_0 a b) at 1. rewrite dist_mix_mix, Rabs_minus_sym.
  rewrite Rabs_pos_eq by lra. now rewrite Rminus_0_r.
Qed.

Lemma dist_mix_right t a b : t <= 1 -> dist (mix t a b) b = (1 - t) * dist a b.
Proof.
  intros. rewrite <- (mix_1 a b) at 2. rewrite dist_mix_mix, Rabs_minus_sym.
  now rewrite Rabs_pos_eq by lra.
Qed.

(* The set of points nearer to one of two points is a half-plane, so it is convex. *)
Lemma nearer_affine t a b x y :
  dist2 (mix t a b) y - dist2 (mix t a b) x =
  (1 - t) * (dist2 a y - dist2 a x) + t * (dist2 b y - dist2 b x).
Proof. unfold dist2, mix. simpl. ring. Qed.

Lemma nearer_convex t a b x y : 0 <= t <= 1 ->
  dist a x < dist a y -> dist b x < dist b y -> dist (mix t a b) x < dist (mix t a b) y.
Proof.
  intros T A B. apply dist_lt in A, B. apply dist_lt. pose proof (nearer_affine t a b x y).
  destruct (Req_dec t 0) as [-> | ]; nra.
Qed.

Lemma nearer_convex_weak t a b x y : 0 <= t <= 1 ->
  dist a x <= dist a y -> dist b x <= dist b y -> dist (mix t a b) x <= dist (mix t a b) y.
Proof.
  intros T A B. apply dist_le in A, B. apply dist_le. pose proof (nearer_affine t a b x y). nra.
Qed.

(* Discs are convex. *)
Lemma dist2_mix t o a b :
  dist2 o (mix t a b) = (1 - t) * dist2 o a + t * dist2 o b - t * (1 - t) * dist2 a b.
Proof. unfold dist2, mix. simpl. ring. Qed.

Lemma disc_convex t o r a b : 0 <= t <= 1 -> dist o a <= r -> dist o b <= r -> dist o (mix t a b) <= r.
Proof.
  intros T A B. pose proof (dist_nonneg o a). pose proof (dist_nonneg o b).
  apply le_of_squares; [lra |]. rewrite dist_sq, dist2_mix, <- (dist_sq o a), <- (dist_sq o b).
  pose proof (dist2_nonneg a b). assert (0 <= t * (1 - t)) by nra. assert (0 <= t * (1 - t) * dist2 a b) by nra.
  assert (dist o a * dist o a <= r * r) by nra. assert (dist o b * dist o b <= r * r) by nra. nra.
Qed.

(* Intermediate values of functions with a Lipschitz constant. *)
Definition lipschitz (K : R) (f : R -> R) : Prop := forall s t, f s - f t <= K * Rabs (s - t).

Lemma lipschitz_continuous K f : lipschitz K f -> continuity f.
Proof.
  intros L t e He. pose (M := Rmax K 0 + 1).
  assert (0 < M) by (unfold M; pose proof (Rmax_r K 0); lra).
  assert (KM : K <= M) by (unfold M; pose proof (Rmax_l K 0); lra).
  exists (e / M). split; [apply Rdiv_lt_0_compat; lra |].
  intros s [_ D]. simpl in *. unfold R_dist in *.
  pose proof (L s t) as A. pose proof (L t s) as B. rewrite (Rabs_minus_sym t s) in B.
  pose proof (Rabs_pos (s - t)).
  assert (M * Rabs (s - t) < e).
  { apply (Rmult_lt_compat_l M) in D; [| lra]. replace (M * (e / M)) with e in D by (field; lra). lra. }
  apply Rabs_def1; nra.
Qed.

Lemma intermediate f : continuity f -> f 0 <= 0 -> 0 <= f 1 -> exists t, 0 <= t <= 1 /\ f t = 0.
Proof.
  intros C A B. destruct (IVT_cor f 0 1 C) as [t H]; [lra | nra |]. exists t. exact H.
Qed.

Lemma lipschitz_dist a b z : lipschitz (dist a b) (fun t => dist (mix t a b) z).
Proof.
  intros s t. pose proof (dist_triangle (mix s a b) (mix t a b) z) as H. rewrite dist_mix_mix in H. lra.
Qed.

Lemma lipschitz_dist_from c a b : lipschitz (dist a b) (fun t => dist c (mix t a b)).
Proof. intros s t. rewrite !(dist_sym c). apply lipschitz_dist. Qed.

Lemma lipschitz_scale K : 0 <= K -> lipschitz K (fun t => (1 - t) * K).
Proof.
  intros H s t. pose proof (Rle_abs (- (s - t))) as A. rewrite Rabs_Ropp in A. nra.
Qed.

Lemma lipschitz_minus K L f g : lipschitz K f -> lipschitz L g -> lipschitz (K + L) (fun t => f t - g t).
Proof.
  intros F G s t. pose proof (F s t). pose proof (G t s). rewrite (Rabs_minus_sym t s) in *. lra.
Qed.

(* A circle about c that has x inside and y outside meets the segment xy. *)
Lemma circle_meets_segment c r x y : dist c x <= r <= dist c y -> exists t, 0 <= t <= 1 /\ dist c (mix t x y) = r.
Proof.
  intros H. destruct (intermediate (fun t => dist c (mix t x y) - r)) as [t [T E]].
  - apply (lipschitz_continuous (dist x y)). intros s t. pose proof (lipschitz_dist_from c x y s t). simpl in *. lra.
  - rewrite mix_0. lra.
  - rewrite mix_1. lra.
  - exists t. split; [exact T | lra].
Qed.
