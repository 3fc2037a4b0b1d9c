(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Motions in discs in proportion to weights [TOL-8], and in squares [TOL-9]: in multiples of the ball of any norm. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Path TiedFace Fan Triangulation Tolerance
  ToleranceStays ToleranceTies ToleranceWhole.
Open Scope R_scope.

Definition minus (a b : point) : point := (fst a - fst b, snd a - snd b).
Definition sum (a b : point) : point := (fst a + fst b, snd a + snd b).
Definition times (t : R) (a : point) : point := (t * fst a, t * snd a).

(* Lengths of vectors. *)
Record norm (nu : point -> R) : Prop := {
  norm_sum : forall a b, nu (sum a b) <= nu a + nu b;
  norm_times : forall t a, nu (times t a) = Rabs t * nu a }.

Definition greatest (a : point) : R := Rmax (Rabs (fst a)) (Rabs (snd a)).

Lemma greatest_norm : norm greatest.
Proof.
  split.
  - intros a b. unfold greatest, sum. cbn. apply Rmax_lub.
    + apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat; apply Rmax_l.
    + apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat; apply Rmax_r.
  - intros t a. unfold greatest, times. cbn. rewrite !Rabs_mult. apply RmaxRmult, Rabs_pos.
Qed.

Lemma length_norm : norm (dist (0, 0)).
Proof.
  split.
  - intros a b. pose proof (dist_triangle (0, 0) a (sum a b)) as H. replace (dist a (sum a b)) with (dist (0, 0) b) in H;
      [exact H |]. unfold dist, dist2, sum. cbn. f_equal. ring.
  - intros t a. apply dist_scaled; [| apply Rabs_pos]. pose proof (Rsqr_abs t) as E. unfold Rsqr in E. rewrite <- E.
    unfold dist2, times. cbn. ring.
Qed.

Section Norm.
Variable nu : point -> R.
Variable Nu : norm nu.

Lemma norm_back a b : nu (minus a b) = nu (minus b a).
Proof.
  replace (minus a b) with (times (-1) (minus b a)) by (unfold times, minus; cbn; f_equal; ring).
  rewrite (norm_times nu Nu). rewrite Rabs_left by lra. lra.
Qed.

Lemma norm_none : nu (0, 0) = 0.
Proof. replace (0, 0) with (times 0 (0, 0)) by (unfold times; cbn; f_equal; ring). rewrite (norm_times nu Nu), Rabs_R0. ring. Qed.

(* The middle one of three that move comes between the others only where the balls about it and about a place between
   the others meet, ... *)
Theorem between_meets u v w u' v' w' s a b c : 0 <= s <= 1 -> v' = mix s u' w' -> nu (minus u' u) <= a -> nu (minus v' v) <= b
  -> nu (minus w' w) <= c -> nu (minus (mix s u w) v) <= b + ((1 - s) * a + s * c).
Proof.
  intros S E A B C. rewrite norm_back in A, C.
  replace (minus (mix s u w) v) with (sum (minus v' v) (sum (times (1 - s) (minus u u')) (times s (minus w w'))))
    by (rewrite E; unfold minus, sum, times, mix; cbn; f_equal; ring).
  pose proof (norm_sum nu Nu (minus v' v) (sum (times (1 - s) (minus u u')) (times s (minus w w')))) as H.
  pose proof (norm_sum nu Nu (times (1 - s) (minus u u')) (times s (minus w w'))) as G.
  rewrite !(norm_times nu Nu), !Rabs_right in G by lra.
  assert ((1 - s) * nu (minus u u') <= (1 - s) * a) by (apply Rmult_le_compat_l; lra).
  assert (s * nu (minus w w') <= s * c) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* ... and does for some motion where they meet. *)
Theorem meets_between u v w s a b c : 0 <= s <= 1 -> 0 <= a -> 0 <= b -> 0 <= c ->
  nu (minus (mix s u w) v) <= b + ((1 - s) * a + s * c) -> exists u' v' w', v' = mix s u' w' /\ nu (minus u' u) <= a /\
  nu (minus v' v) <= b /\ nu (minus w' w) <= c.
Proof.
  intros S A B C H. set (e := b + ((1 - s) * a + s * c)) in *. set (d := minus (mix s u w) v) in *.
  assert (P : 0 <= (1 - s) * a) by (apply Rmult_le_pos; lra). assert (Q : 0 <= s * c) by (apply Rmult_le_pos; lra).
  assert (Zero : forall x, nu (minus x x) = 0).
  { intros x. replace (minus x x) with (0, 0) by (unfold minus; f_equal; ring). exact norm_none. }
  destruct (Rle_lt_or_eq_dec 0 e ltac:(unfold e; lra)) as [L | L].
  - assert (K : forall r, 0 <= r -> nu (times (r / e) d) <= r).
    { intros r R. assert (F : 0 <= r / e) by (apply Rle_mult_inv_pos; lra). rewrite (norm_times nu Nu), Rabs_right by lra.
      apply Rle_trans with (r / e * e); [now apply Rmult_le_compat_l | right; field; lra]. }
    exists (minus u (times (a / e) d)), (sum v (times (b / e) d)), (minus w (times (c / e) d)). split; [| split; [| split]].
    + assert (G : b / e = 1 - ((1 - s) * (a / e) + s * (c / e))) by (unfold e in *; field; lra).
      rewrite G. unfold d, sum, minus, times, mix. cbn. f_equal; ring.
    + replace (minus (minus u (times (a / e) d)) u) with (minus (minus u u) (times (a / e) d))
        by (unfold minus; cbn; f_equal; ring).
      rewrite norm_back. replace (minus (times (a / e) d) (minus u u)) with (times (a / e) d)
        by (unfold minus, times; cbn; f_equal; ring). now apply K.
    + replace (minus (sum v (times (b / e) d)) v) with (times (b / e) d) by (unfold minus, sum, times; cbn; f_equal; ring).
      now apply K.
    + rewrite norm_back. replace (minus w (minus w (times (c / e) d))) with (times (c / e) d)
        by (unfold minus, times; cbn; f_equal; ring). now apply K.
  - exists u, (mix s u w), w. rewrite !Zero. fold d. repeat split; try assumption. lra.
Qed.

(* Each point moves by at most s < t times its weight. A pair that is strictly an edge is one for all motions of less
   than t, and balls that grow with the weights do not meet on a chord before t: then no status changes. *)
Theorem norm_unchanged N p q faces rim edge (sk : skeleton N p faces rim edge) r t : (forall k, 0 <= r k) ->
  (forall k l, (k < N)%nat -> (l < N)%nat -> k <> l -> p k <> p l) ->
  (forall i j, edge i j -> (i < N)%nat /\ (j < N)%nat /\ i <> j /\ strict_edge N p i j) ->
  (forall i j s z, (i < N)%nat -> (j < N)%nat -> i <> j -> strict_edge N p i j -> 0 <= s < t ->
    (forall k, (k < N)%nat -> nu (minus (z k) (p k)) <= s * r k) -> strict_edge N z i j) ->
  (forall u v w, rim u v -> rim v w -> edge u w \/ forall s, 0 <= s <= 1 -> 0 < nu (minus (mix s (p u) (p w)) (p v)) /\
    t * (r v + ((1 - s) * r u + s * r w)) <= nu (minus (mix s (p u) (p w)) (p v))) ->
  (exists s, 0 <= s < t /\ forall k, (k < N)%nat -> nu (minus (q k) (p k)) <= s * r k) ->
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> same_status N p q a b.
Proof.
  intros Pos Diff Strict Deaths Corners (s & S & M).
  assert (On : forall x k, 0 <= x <= 1 -> (k < N)%nat -> nu (minus (path p q x k) (p k)) <= s * r k).
  { intros x k X K. replace (minus (path p q x k) (p k)) with (times x (minus (q k) (p k)))
      by (unfold path, mix, minus, times; cbn; f_equal; ring).
    rewrite (norm_times nu Nu), Rabs_right by lra. specialize (M k K). specialize (Pos k).
    assert (0 <= s * r k) by (apply Rmult_le_pos; lra). nra. }
  apply (statuses_stay N p q faces rim edge sk Diff).
  - intros i j E. destruct (Strict i j E) as (I & J & D & St). repeat split; auto.
  - intros i j I J D St x X. apply (Deaths i j s); auto.
  - intros u v w Ruv Rvw. right. destruct (Corners u v w Ruv Rvw) as [E | H]; [now left | right].
    destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V _]]. destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W _]].
    intros x X (y & Y & E). destruct (H y Y) as [G F]. pose proof (between_meets _ (p v) _ _ _ _ y _ _ _ Y E (On x u X U)
      (On x v X V) (On x w X W)) as L.
    assert (P : 0 <= r v + ((1 - y) * r u + y * r w)).
    { pose proof (Pos u). pose proof (Pos v). pose proof (Pos w).
      assert (0 <= (1 - y) * r u) by (apply Rmult_le_pos; lra). assert (0 <= y * r w) by (apply Rmult_le_pos; lra). lra. }
    replace (s * r v + ((1 - y) * (s * r u) + y * (s * r w))) with (s * (r v + ((1 - y) * r u + y * r w))) in L by ring.
    nra.
Qed.
End Norm.

(* |a + s d| / (b + s c), b + s c > 0, is least where it is stationary, at z: where its square is l there, it is nowhere
   less. *)
Theorem stationary_is_least ax ay dx dy b c l z s : 0 < b + z * c ->
  (ax + z * dx) * (ax + z * dx) + (ay + z * dy) * (ay + z * dy) = l * ((b + z * c) * (b + z * c)) ->
  (ax + z * dx) * dx + (ay + z * dy) * dy = l * ((b + z * c) * c) ->
  l * ((b + s * c) * (b + s * c)) <= (ax + s * dx) * (ax + s * dx) + (ay + s * dy) * (ay + s * dy).
Proof.
  intros P E F. set (k := dx * dx + dy * dy - l * (c * c)).
  assert (H : forall x, (ax + x * dx) * (ax + x * dx) + (ay + x * dy) * (ay + x * dy) - l * ((b + x * c) * (b + x * c)) =
    k * ((x - z) * (x - z))).
  { intros x. unfold k. replace (ax + x * dx) with (ax + z * dx + (x - z) * dx) by ring.
    replace (ay + x * dy) with (ay + z * dy + (x - z) * dy) by ring.
    replace (b + x * c) with (b + z * c + (x - z) * c) by ring.
    transitivity (((ax + z * dx) * (ax + z * dx) + (ay + z * dy) * (ay + z * dy) - l * ((b + z * c) * (b + z * c))) +
      2 * (x - z) * ((ax + z * dx) * dx + (ay + z * dy) * dy - l * ((b + z * c) * c)) + k * ((x - z) * (x - z)));
      [unfold k; ring | rewrite E, F; unfold k; ring]. }
  assert (K : 0 <= k).
  { destruct (Req_dec c 0) as [-> | C]; [unfold k; nra |].
    pose proof (H (- b / c)) as G. replace (b + - b / c * c) with 0 in G by (field; exact C).
    assert (W : (- b / c - z) * c <> 0) by (replace ((- b / c - z) * c) with (- (b + z * c)) by (field; exact C); lra).
    assert (W' : - b / c - z <> 0) by (intros Z; apply W; rewrite Z; ring).
    pose proof (Rsqr_pos_lt _ W') as Q. unfold Rsqr in Q.
    set (m := (- b / c - z) * (- b / c - z)) in *.
    assert (0 <= k * m) by (rewrite <- G; pose proof (Rle_0_sqr (ax + - b / c * dx)); pose proof (Rle_0_sqr (ay + - b / c
      * dy)); unfold Rsqr in *; lra). apply Rnot_lt_le. intros L. nra. }
  specialize (H s). assert (0 <= k * ((s - z) * (s - z))) by (apply Rmult_le_pos; [exact K | apply Rle_0_sqr]). lra.
Qed.

(* Squares: half the distance, in the norm, of v to the line uw. *)
Theorem corner_in_squares u v w t s : 0 <= s <= 1 -> 0 < orient u v w ->
  2 * t * (Rabs (fst w - fst u) + Rabs (snd w - snd u)) <= orient u v w ->
  0 < greatest (minus (mix s u w) v) /\ t * (1 + ((1 - s) * 1 + s * 1)) <= greatest (minus (mix s u w) v).
Proof.
  intros S P H. set (m := greatest (minus (mix s u w) v)). set (x := fst w - fst u) in *. set (y := snd w - snd u) in *.
  assert (M : orient u v w <= m * (Rabs x + Rabs y)).
  { set (e := minus (mix s u w) v). assert (E : orient u v w = snd e * x - fst e * y)
      by (unfold e, x, y, orient, minus, mix; cbn; ring).
    rewrite E. apply Rle_trans with (1 := Rle_abs _). apply Rle_trans with (1 := Rabs_triang _ (- (fst e * y))).
    rewrite Rabs_Ropp, !Rabs_mult. unfold m, greatest. fold e.
    pose proof (Rmax_l (Rabs (fst e)) (Rabs (snd e))). pose proof (Rmax_r (Rabs (fst e)) (Rabs (snd e))).
    pose proof (Rabs_pos x). pose proof (Rabs_pos y). nra. }
  assert (L : 0 < Rabs x + Rabs y).
  { pose proof (Rabs_pos x). pose proof (Rabs_pos y). apply Rnot_le_lt. intros Z. assert (Rabs x + Rabs y = 0) by lra.
    replace (Rabs x + Rabs y) with 0 in M by lra. lra. }
  split; [apply Rnot_le_lt; intros Z; nra |]. apply Rmult_le_reg_r with (Rabs x + Rabs y); [exact L |]. lra.
Qed.

(* A square of half-width t holds the disc of radius t, and is in that of radius sqrt 2 t. *)
Theorem disc_square_disc a t : (dist (0, 0) a <= t -> greatest a <= t) /\
  (greatest a <= t -> dist (0, 0) a <= sqrt 2 * t).
Proof.
  assert (Sq : dist (0, 0) a * dist (0, 0) a = fst a * fst a + snd a * snd a) by (rewrite dist_sq; unfold dist2; cbn; ring).
  pose proof (dist_nonneg (0, 0) a) as D. unfold greatest. split; intros H.
  - apply Rmax_lub; apply Rle_trans with (2 := H); rewrite <- (Rabs_right (dist (0, 0) a)) by lra; apply Rsqr_le_abs_0;
      unfold Rsqr; nra.
  - pose proof (Rle_trans _ _ _ (Rmax_l _ _) H) as X. pose proof (Rle_trans _ _ _ (Rmax_r _ _) H) as Y.
    pose proof (Rabs_pos (fst a)). pose proof (sqrt_sqrt 2 ltac:(lra)) as R. pose proof (sqrt_pos 2).
    assert (0 <= t) by lra. apply Rsqr_incr_0_var; [| apply Rmult_le_pos; lra]. unfold Rsqr. rewrite Sq.
    assert (fst a * fst a <= t * t) by (rewrite <- (Rabs_right t) in X by lra;
      apply Rsqr_le_abs_1 in X; exact X).
    assert (snd a * snd a <= t * t) by (rewrite <- (Rabs_right t) in Y by lra; apply Rsqr_le_abs_1 in Y; exact Y).
    replace (sqrt 2 * t * (sqrt 2 * t)) with (sqrt 2 * sqrt 2 * (t * t)) by ring. rewrite R. lra.
Qed.
