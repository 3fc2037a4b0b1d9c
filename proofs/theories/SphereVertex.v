(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Voronoi vertices on the sphere [SPH-4]: the direction of (b - a) x (c - a), for a triangle a, b, c that is
   counterclockwise seen from outside. *)
From Coq Require Import Reals Lra Lia Psatz.
From Dyadel Require Import Sphere.
Open Scope R_scope.

Definition times (u v : space) : space :=
  Space (sy u * sz v - sz u * sy v) (sz u * sx v - sx u * sz v) (sx u * sy v - sy u * sx v).
Definition scaled (t : R) (v : space) : space := Space (t * sx v) (t * sy v) (t * sz v).
Definition space_dist2 (v w : space) : R := inner (minus v w) (minus v w).

Lemma expand h u v z : inner h z * inner (times u v) (times u v) =
  inner h u * inner (times v (times u v)) z + inner h v * inner (times (times u v) u) z +
  inner h (times u v) * inner (times u v) z.
Proof. unfold inner, times. simpl. ring. Qed.

Lemma inner_minus h v w : inner h (minus v w) = inner h v - inner h w.
Proof. unfold inner, minus. simpl. ring. Qed.

Lemma inner_scaled t n v : inner (scaled t n) v = t * inner n v.
Proof. unfold inner, scaled. simpl. ring. Qed.

(* From outside it is counterclockwise: some further site w is below the plane of the three. x is the direction. *)
Theorem sphere_vertex N y i j l w t : places N y -> (i < N)%nat -> (j < N)%nat -> (l < N)%nat -> (w < N)%nat ->
  sphere_triangle N y i j l ->
  triple (minus (y j) (y i)) (minus (y l) (y i)) (minus (y w) (y i)) < 0 -> 0 < t ->
  let x := scaled t (times (minus (y j) (y i)) (minus (y l) (y i))) in on_sphere x ->
  space_dist2 x (y j) = space_dist2 x (y i) /\ space_dist2 x (y l) = space_dist2 x (y i) /\
  forall k, (k < N)%nat -> k <> i -> k <> j -> k <> l -> space_dist2 x (y i) < space_dist2 x (y k).
Proof.
  intros [On _] I J L W [h [m [_ [Hi [Hj [Hl H]]]]]] Turn T x X.
  set (u := minus (y j) (y i)) in *. set (v := minus (y l) (y i)) in *. set (n := times u v).
  assert (Nn : forall z, inner n z = triple u v z) by (intros z; unfold n, inner, times, triple; simpl; ring).
  assert (Hu : inner h u = 0) by (unfold u; rewrite inner_minus; lra).
  assert (Hv : inner h v = 0) by (unfold v; rewrite inner_minus; lra).
  assert (E : forall z, inner h z * inner n n = inner h n * inner n z).
  { intros z. pose proof (expand h u v z) as K. fold n in K. rewrite Hu, Hv in K. lra. }
  assert (Di : w <> i).
  { intros ->. revert Turn. unfold u, v, triple, minus. simpl. intros K.
    match type of K with ?e < 0 => replace e with 0 in K by ring end. lra. }
  assert (Dj : w <> j).
  { intros ->. revert Turn. unfold u, v, triple, minus. simpl. intros K.
    match type of K with ?e < 0 => replace e with 0 in K by ring end. lra. }
  assert (Dl : w <> l).
  { intros ->. revert Turn. unfold u, v, triple, minus. simpl. intros K.
    match type of K with ?e < 0 => replace e with 0 in K by ring end. lra. }
  assert (P : 0 < inner n n).
  { pose proof (inner_nonneg n). destruct (Req_dec (inner n n) 0) as [Z | Z]; [| lra].
    apply inner_zero in Z. rewrite <- Nn, Z in Turn. unfold inner in Turn. simpl in Turn. lra. }
  assert (S : 0 < inner h n).
  { pose proof (E (minus (y w) (y i))) as K. rewrite (Nn (minus (y w) (y i))), inner_minus in K. pose proof (H w W Di Dj Dl).
    assert (A : 0 < (inner h (y i) - inner h (y w)) * inner n n) by (apply Rmult_lt_0_compat; lra).
    apply Rnot_le_lt. intros Le.
    assert (0 <= inner h n * triple u v (minus (y w) (y i))); [| lra].
    replace (inner h n * triple u v (minus (y w) (y i))) with (- inner h n * - triple u v (minus (y w) (y i))) by ring.
    apply Rmult_le_pos; lra. }
  assert (Du : forall k, (k < N)%nat -> space_dist2 x (y k) = 2 - 2 * (t * inner n (y k))).
  { intros k K. unfold space_dist2. rewrite minus_sq. rewrite X, (On k K). unfold x. rewrite inner_scaled. fold n. ring. }
  assert (Nu : inner n (minus (y j) (y i)) = 0) by (rewrite Nn; unfold u, triple; simpl; ring).
  assert (Nv : inner n (minus (y l) (y i)) = 0) by (rewrite Nn; unfold v, triple; simpl; ring).
  rewrite inner_minus in Nu, Nv. rewrite (Du i I), (Du j J), (Du l L).
  replace (inner n (y j)) with (inner n (y i)) by lra. replace (inner n (y l)) with (inner n (y i)) by lra.
  split; [reflexivity |]. split; [reflexivity |]. intros k K Ki Kj Kl. rewrite (Du k K).
  pose proof (E (minus (y k) (y i))) as G. rewrite !inner_minus in G. pose proof (H k K Ki Kj Kl).
  assert (A : 0 < (inner h (y i) - inner h (y k)) * inner n n) by (apply Rmult_lt_0_compat; lra).
  assert (Q : inner n (y k) < inner n (y i)).
  { apply (Rmult_lt_reg_l (inner h n)); [exact S |]. lra. }
  pose proof (Rmult_lt_compat_l t _ _ T Q). lra.
Qed.
