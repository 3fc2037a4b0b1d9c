(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Legal pairs: a witness makes a strictly Delaunay edge of every choice. *)
From Coq Require Import Reals Lra Lia Psatz Classical ZArith.
From Dyadel Require Import Plane Finite Distance Cells.
Open Scope R_scope.

(* c is a witness: the larger of dl_i, dl_j is below every other ds_k. *)
Definition witness (N : nat) (B : sites) (i j : nat) (c : point) : Prop :=
  forall k, (k < N)%nat -> k <> i -> k <> j -> dl c (B i) < ds c (B k) /\ dl c (B j) < ds c (B k).
Definition legal (N : nat) (B : sites) (i j : nat) : Prop := exists c, witness N B i j c.

(* A circle goes through p i and p j; all other points are strictly outside. *)
Definition strict_edge (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  exists c, dist c (p i) = dist c (p j) /\
    forall k, (k < N)%nat -> k <> i -> k <> j -> dist c (p i) < dist c (p k).

(* A disc about c with x on its circle and y inside contains a smaller one, touching it at x, with both on the circle. *)
Lemma shrink c x y : dist c y <= dist c x ->
  exists t, 0 <= t <= 1 /\ dist (mix t c x) x = dist (mix t c x) y /\ dist (mix t c x) x = (1 - t) * dist c x.
Proof.
  intros H. set (f t := dist (mix t c x) y - (1 - t) * dist c x). destruct (intermediate f) as [t [T E]].
  - apply (lipschitz_continuous (dist c x + dist c x)). apply lipschitz_minus.
    + apply lipschitz_dist.
    + apply lipschitz_scale, dist_nonneg.
  - unfold f. rewrite mix_0. lra.
  - unfold f. pose proof (dist_nonneg (mix 1 c x) y). lra.
  - exists t. unfold f in E. rewrite dist_mix_right by lra. repeat split; lra.
Qed.

Lemma shrunken_misses c x t r z : 0 <= t <= 1 -> dist c x <= r -> r < dist c z -> (1 - t) * dist c x < dist (mix t c x) z.
Proof.
  intros T X Z. pose proof (dist_triangle c (mix t c x) z) as H. rewrite dist_mix_left in H by lra. lra.
Qed.

Theorem enclosing_disc_gives_edge N p i j c :
  (forall k, (k < N)%nat -> k <> i -> k <> j -> dist c (p i) < dist c (p k) /\ dist c (p j) < dist c (p k)) ->
  strict_edge N p i j.
Proof.
  intros H. destruct (Rle_dec (dist c (p j)) (dist c (p i))) as [L | L].
  - destruct (shrink c (p i) (p j) L) as [t [T [E F]]]. exists (mix t c (p i)). split; [exact E |].
    intros k K Di Dj. rewrite F. apply shrunken_misses with (r := dist c (p i)); [exact T | lra | now apply H].
  - destruct (shrink c (p j) (p i)) as [t [T [E F]]]; [lra |]. exists (mix t c (p j)). split; [now symmetry |].
    intros k K Di Dj. rewrite <- E, F. apply shrunken_misses with (r := dist c (p j)); [exact T | lra | now apply H].
Qed.

Theorem legal_sound N B i j p : (i < N)%nat -> (j < N)%nat ->
  legal N B i j -> choice N B p -> strict_edge N p i j.
Proof.
  intros I J [c W] P. apply enclosing_disc_gives_edge with (c := c). intros k K Di Dj.
  pose proof (W k K Di Dj). pose proof (le_dl c _ _ (P i I)). pose proof (le_dl c _ _ (P j J)).
  pose proof (ds_le c _ _ (P k K)). lra.
Qed.

(* A witness found once stays valid for ever. *)
Theorem witness_monotone N B' B i j c : (i < N)%nat -> (j < N)%nat -> refined N B' B ->
  witness N B i j c -> witness N B' i j c.
Proof.
  intros I J F W k K Di Dj. pose proof (W k K Di Dj). pose proof (dl_monotone c _ _ (F i I)).
  pose proof (dl_monotone c _ _ (F j J)). pose proof (ds_monotone c _ _ (F k K)). lra.
Qed.

Corollary legal_monotone N B' B i j : (i < N)%nat -> (j < N)%nat -> refined N B' B -> legal N B i j -> legal N B' i j.
Proof. intros I J F [c W]. exists c. exact (witness_monotone N B' B i j c I J F W). Qed.

Lemma closer_rect_convex a b t X Y : 0 <= t <= 1 -> dl a X < ds a Y -> dl b X < ds b Y ->
  dl (mix t a b) X < ds (mix t a b) Y.
Proof.
  intros T A H. apply nearer_convex; [exact T | |].
  - pose proof (le_dl a _ _ (farthest_inside (mix t a b) X)). pose proof (ds_le a _ _ (nearest_inside (mix t a b) Y)). lra.
  - pose proof (le_dl b _ _ (farthest_inside (mix t a b) X)). pose proof (ds_le b _ _ (nearest_inside (mix t a b) Y)). lra.
Qed.

Theorem witness_convex N B i j a b t : 0 <= t <= 1 ->
  witness N B i j a -> witness N B i j b -> witness N B i j (mix t a b).
Proof.
  intros T A H k K Di Dj. destruct (A k K Di Dj). destruct (H k K Di Dj).
  split; now apply closer_rect_convex.
Qed.

Theorem witness_open N B i j c : witness N B i j c ->
  exists e, 0 < e /\ forall x, dist c x <= e -> witness N B i j x.
Proof.
  intros W.
  destruct (small_finite (fun k d => k <> i -> k <> j ->
    dl c (B i) + d < ds c (B k) - d /\ dl c (B j) + d < ds c (B k) - d) N) as [e [E L]].
  { intros k K. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D].
    - destruct (W k K Di Dj) as [U V].
      pose proof (small_and _ _ (less_open _ _ U) (less_open _ _ V)) as S. revert S. apply small_weaken. now intros.
    - exists 1. split; [lra |]. intros d _ Di Dj. exfalso. now apply D. }
  exists e. split; [exact E |]. intros x X k K Di Dj. destruct (L e (conj E (Rle_refl e)) k K Di Dj).
  pose proof (dl_move x c (B i)). pose proof (dl_move x c (B j)). pose proof (ds_move c x (B k)).
  rewrite (dist_sym x c) in *. lra.
Qed.

(* Dyadic numbers and points. *)
Definition dyadic (x : R) : Prop := exists (m : Z) (n : nat), x = IZR m / 2 ^ n.
Definition dyadic_point (c : point) : Prop := dyadic (fst c) /\ dyadic (snd c).

Lemma dyadic_dense x e : 0 < e -> exists y, dyadic y /\ Rabs (x - y) <= e.
Proof.
  intros E. destruct (archimed_cor1 e E) as [n [A Hn]].
  assert (P : 0 < 2 ^ n) by (apply pow_lt; lra).
  assert (G : / 2 ^ n <= e).
  { assert (INR n <= 2 ^ n).
    { clear. induction n as [| n IH]; [simpl; lra |]. rewrite S_INR. simpl. pose proof (pow_R1_Rle 2 n). lra. }
    pose proof (Rinv_le_contravar (INR n) (2 ^ n) (lt_0_INR n Hn) H). lra. }
  destruct (archimed (x * 2 ^ n)) as [U V]. exists (IZR (up (x * 2 ^ n)) / 2 ^ n).
  split; [now exists (up (x * 2 ^ n)), n |].
  apply Rle_trans with (/ 2 ^ n); [| exact G].
  replace (x - IZR (up (x * 2 ^ n)) / 2 ^ n) with ((x * 2 ^ n - IZR (up (x * 2 ^ n))) * / 2 ^ n) by (field; lra).
  rewrite Rabs_mult, (Rabs_pos_eq (/ 2 ^ n)) by (left; now apply Rinv_0_lt_compat).
  pose proof (Rinv_0_lt_compat _ P).
  assert (Rabs (x * 2 ^ n - IZR (up (x * 2 ^ n))) <= 1) by (apply Rabs_le; lra). nra.
Qed.

Lemma dist_le_sum a b : dist a b <= Rabs (fst a - fst b) + Rabs (snd a - snd b).
Proof.
  apply le_of_squares; [pose proof (Rabs_pos (fst a - fst b)); pose proof (Rabs_pos (snd a - snd b)); lra |].
  rewrite dist_sq. unfold dist2. pose proof (Rabs_pos (fst a - fst b)). pose proof (Rabs_pos (snd a - snd b)).
  pose proof (Rsqr_abs (fst a - fst b)) as X. pose proof (Rsqr_abs (snd a - snd b)) as Y. unfold Rsqr in X, Y. nra.
Qed.

Lemma dyadic_point_dense c e : 0 < e -> exists x, dyadic_point x /\ dist c x <= e.
Proof.
  intros E. destruct (dyadic_dense (fst c) (e / 2)) as [u [U Hu]]; [lra |].
  destruct (dyadic_dense (snd c) (e / 2)) as [v [V Hv]]; [lra |].
  exists (u, v). split; [now split |]. pose proof (dist_le_sum c (u, v)). simpl in *. lra.
Qed.

(* If there is a witness at all, there is a dyadic one. *)
Theorem dyadic_witness N B i j : legal N B i j -> exists c, dyadic_point c /\ witness N B i j c.
Proof.
  intros [c W]. destruct (witness_open N B i j c W) as [e [E H]].
  destruct (dyadic_point_dense c e E) as [x [D L]]. exists x. split; [exact D | now apply H].
Qed.

(* Cutting planes: where c fails, with q the point of R_k nearest to c and s the corner of R_i farthest from it, every
   witness is nearer to s than to q, and c is not. *)
Theorem cutting_plane N B i j k c w : (k < N)%nat -> k <> i -> k <> j ->
  ds c (B k) <= dl c (B i) -> witness N B i j w ->
  dist w (farthest c (B i)) < dist w (nearest c (B k)) /\ dist c (nearest c (B k)) <= dist c (farthest c (B i)).
Proof.
  intros K Di Dj F W. destruct (W k K Di Dj). pose proof (le_dl w _ _ (farthest_inside c (B i))).
  pose proof (ds_le w _ _ (nearest_inside c (B k))). split; [lra | exact F].
Qed.

Lemma witness_sym N B i j c : witness N B i j c -> witness N B j i c.
Proof. intros W k K Dj Di. destruct (W k K Di Dj). now split. Qed.

(* Far witnesses: if R_i is strictly beyond R_k in direction u, points far away in that direction are nearer to it. *)
Lemma far_nearer p u X Y e : 0 < e -> dot u (highest u Y) + e <= dot u (lowest u X) ->
  exists t0, 0 <= t0 /\ forall t, t0 < t ->
    dl (fst p + t * fst u, snd p + t * snd u) X < ds (fst p + t * fst u, snd p + t * snd u) Y.
Proof.
  intros E H. exists (dl p X * dl p X / (2 * e)). split.
  { apply Rmult_le_pos; [pose proof (dl_nonneg p X); nra |]. left. apply Rinv_0_lt_compat. lra. }
  intros t T. set (c := (fst p + t * fst u, snd p + t * snd u)).
  assert (T2 : dl p X * dl p X < 2 * t * e).
  { apply (Rmult_lt_compat_r (2 * e)) in T; [| lra]. unfold Rdiv in T. rewrite Rmult_assoc, Rinv_l in T by lra. lra. }
  set (x := farthest c X). set (y := nearest c Y). apply dist_lt. fold x y.
  assert (K : dist2 c x - dist2 c y = dist2 p x - dist2 p y - 2 * t * (dot u x - dot u y))
    by (unfold c, dist2, dot; simpl; ring).
  destruct (lowest_spec u X) as [_ A]. destruct (highest_spec u Y) as [_ B].
  specialize (A x (farthest_inside c X)). specialize (B y (nearest_inside c Y)).
  pose proof (le_dl p X x (farthest_inside c X)) as D. pose proof (dist_nonneg p x).
  assert (dist2 p x <= dl p X * dl p X) by (rewrite <- dist_sq; nra). pose proof (dist2_nonneg p y).
  assert (0 < t).
  { assert (0 <= dl p X * dl p X) by (pose proof (dl_nonneg p X); nra). nra. }
  assert (2 * t * e <= 2 * t * (dot u x - dot u y)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* If R_i and R_j are strictly beyond all others in direction u, every point far enough in that direction is a witness. *)
Theorem far_witness N B i j p u : (i < N)%nat -> (j < N)%nat ->
  (forall k, (k < N)%nat -> k <> i -> k <> j ->
    dot u (highest u (B k)) < dot u (lowest u (B i)) /\ dot u (highest u (B k)) < dot u (lowest u (B j))) ->
  exists t0, forall t, t0 < t -> witness N B i j (fst p + t * fst u, snd p + t * snd u).
Proof.
  intros I J H.
  destruct (finite_choice 0 (fun k t0 => k <> i -> k <> j -> forall t, t0 < t ->
    dl (fst p + t * fst u, snd p + t * snd u) (B i) < ds (fst p + t * fst u, snd p + t * snd u) (B k) /\
    dl (fst p + t * fst u, snd p + t * snd u) (B j) < ds (fst p + t * fst u, snd p + t * snd u) (B k)) N) as [f F].
  { intros k K. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D].
    - destruct (H k K Di Dj) as [U V].
      destruct (far_nearer p u (B i) (B k) (dot u (lowest u (B i)) - dot u (highest u (B k)))) as [a [_ A]]; [lra | lra |].
      destruct (far_nearer p u (B j) (B k) (dot u (lowest u (B j)) - dot u (highest u (B k)))) as [b [_ G]]; [lra | lra |].
      exists (Rmax a b). intros _ _ t T. pose proof (Rmax_l a b). pose proof (Rmax_r a b). split; [apply A | apply G]; lra.
    - exists 0. intros Di Dj. exfalso. now apply D. }
  destruct (finite_max (fun _ => True) f N) as [m [M [_ L]]]; [now exists i |].
  exists (f m). intros t T k K Di Dj. apply (F k K Di Dj). pose proof (L k K Logic.I). lra.
Qed.

(* C_ij is convex at infinity too: from a point of it one stays in it in every direction in which no point of R_j is
   beyond one of R_i. *)
Theorem closer_rect_ray p u X Y t : 0 <= t -> dl p X < ds p Y ->
  (forall x y, inside x X -> inside y Y -> dot u y <= dot u x) ->
  dl (fst p + t * fst u, snd p + t * snd u) X < ds (fst p + t * fst u, snd p + t * snd u) Y.
Proof.
  intros T H U. set (c := (fst p + t * fst u, snd p + t * snd u)).
  set (x := farthest c X). set (y := nearest c Y). apply dist_lt. fold x y.
  assert (K : dist2 c x - dist2 c y = dist2 p x - dist2 p y - 2 * t * (dot u x - dot u y))
    by (unfold c, dist2, dot; simpl; ring).
  pose proof (U x y (farthest_inside c X) (nearest_inside c Y)).
  pose proof (le_dl p X x (farthest_inside c X)). pose proof (ds_le p Y y (nearest_inside c Y)).
  assert (Q : dist p x < dist p y) by lra. apply dist_lt in Q.
  assert (0 <= t * (dot u x - dot u y)) by (apply Rmult_le_pos; lra). lra.
Qed.
