(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Who blocks a centre of the curve on which two rectangles are equally far [COV-1] [COV-2]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Nerve Curve Disc.
Open Scope R_scope.

(* k blocks c: every point of R_k is nearer to c than R_i. *)
Definition blocks (c : point) (X K : rect) : Prop := dl c K < ds c X.

(* The pair is possible iff a centre at equal distances, or a direction, is blocked by no site. *)
Theorem possible_unblocked N B i j : (i < N)%nat -> (j < N)%nat ->
  (possible N B i j <-> (exists c, ds c (B i) = ds c (B j) /\ forall k, (k < N)%nat -> k <> i -> k <> j -> ~ blocks c
    (B i) (B k)) \/
    (exists u, possible_far N B (pair i j) u)).
Proof.
  intros I J. unfold possible. split; (intros [H | H]; [left | now right]).
  - destruct (equal_distances_suffice N B i j I J H) as [c [E O]]. exists c. split; [exact E |].
    intros k K Di Dj Bl. unfold blocks in Bl. destruct (O k K Di Dj). lra.
  - destruct H as [c [E O]]. exists c. intros k K Di Dj. specialize (O k K Di Dj). unfold blocks in O. split; lra.
Qed.

(* A direction in which one of the two rectangles is higher than the other leads to a centre: the disc that touches the
   line from beyond, where the lower one ends, is free, and grows until it reaches the higher one. *)
Lemma higher_has_centre N B i j u : (i < N)%nat -> (j < N)%nat ->
  possible_far N B (pair i j) u -> dot u (highest u (B j)) < dot u (highest u (B i)) ->
  exists c, ds c (B i) = ds c (B j) /\ forall k, (k < N)%nat -> ds c (B i) <= dl c (B k).
Proof.
  intros I J [U H] L. set (q := highest u (B j)) in *. set (z := highest u (B i)) in *.
  destruct (highest_spec u (B j)) as [Qj Top]. fold q in Qj, Top. destruct (highest_spec u (B i)) as [Zi _].
    fold z in Zi.
  set (w := sqrt (dot u u)). assert (W2 : w * w = dot u u) by (apply sqrt_sqrt; unfold dot; nra).
  assert (W0 : 0 <= w) by apply sqrt_pos.
  set (c t := (fst q + t * fst u, snd q + t * snd u)).
  assert (E : forall t y, dist2 (c t) y = dist2 q y + 2 * t * (dot u q - dot u y) + t * w * (t * w)).
  { intros t y. replace (t * w * (t * w)) with (t * t * (w * w)) by ring. rewrite W2. unfold c, dist2, dot. simpl.
    ring. }
  assert (Far : forall t y, 0 <= t -> dot u y <= dot u q -> t * w <= dist (c t) y).
  { intros t y T Y. apply le_of_squares; [apply dist_nonneg |]. rewrite dist_sq, E. pose proof (dist2_nonneg q y).
    assert (0 <= 2 * t * (dot u q - dot u y)) by (apply Rmult_le_pos; lra). lra. }
  assert (At : forall t, 0 <= t -> dist (c t) q = t * w).
  { intros t T. apply Rle_antisym; [| apply Far; lra]. apply le_of_squares; [apply Rmult_le_pos; lra |].
    rewrite dist_sq, E. replace (dist2 q q) with 0 by (unfold dist2; ring). lra. }
  assert (Dj : forall t, 0 <= t -> ds (c t) (B j) = t * w).
  { intros t T. apply Rle_antisym; [rewrite <- (At t T); now apply ds_le |]. apply Far; [exact T |].
    apply Top, nearest_inside. }
  assert (Dk : forall t k, 0 <= t -> (k < N)%nat -> t * w <= dl (c t) (B k)).
  { intros t k T K. destruct (lowest_spec u (B k)) as [X _]. pose proof (H j k J (or_intror eq_refl) K) as Y.
    fold q in Y.
    pose proof (le_dl (c t) _ _ X). pose proof (Far t _ T Y). lra. }
  (* far enough the disc reaches the higher rectangle *)
  set (h := dot u z - dot u q). assert (Hh : 0 < h) by (unfold h; lra). set (R := dist2 q z / (2 * h)).
  assert (R0 : 0 <= R) by (apply Rle_mult_inv_pos; [apply dist2_nonneg | lra]).
  assert (Reach : ds (c R) (B i) <= R * w).
  { apply Rle_trans with (dist (c R) z); [now apply ds_le |]. apply le_of_squares; [apply Rmult_le_pos; lra |].
    rewrite dist_sq, E. assert (Q : R * (2 * h) = dist2 q z) by (unfold R; field; lra). unfold h in Q. lra. }
  destruct (intermediate (fun t => t * R * w - ds (c (t * R)) (B i))) as [t [T Z]].
  - apply (lipschitz_continuous (R * w + R * w)). intros s t.
    pose proof (ds_move (c (t * R)) (c (s * R)) (B i)) as M.
    assert (D : dist (c (t * R)) (c (s * R)) = R * w * Rabs (s - t)).
    { replace (R * w * Rabs (s - t)) with (sqrt (dist2 (c (t * R)) (c (s * R)))); [reflexivity |].
      replace (dist2 (c (t * R)) (c (s * R))) with (Rsqr (R * w * (s - t))).
      - rewrite sqrt_Rsqr_abs, Rabs_mult, (Rabs_pos_eq (R * w)); [reflexivity | apply Rmult_le_pos; lra].
      - unfold Rsqr. transitivity (R * R * (w * w) * ((s - t) * (s - t))); [ring |]. rewrite W2.
        unfold c, dist2, dot. simpl. ring. }
    rewrite D in M. pose proof (Rle_abs (s - t)). assert (0 <= R * w) by (apply Rmult_le_pos; lra).
    assert (R * w * (s - t) <= R * w * Rabs (s - t)) by (apply Rmult_le_compat_l; lra). lra.
  - rewrite !Rmult_0_l. pose proof (ds_nonneg (c 0) (B i)). lra.
  - rewrite Rmult_1_l. lra.
  - assert (P : 0 <= t * R) by (apply Rmult_le_pos; lra). exists (c (t * R)). split.
    + rewrite Dj by exact P. lra.
    + intros k K. pose proof (Dk (t * R) k P K). lra.
Qed.

(* So of all directions only the common tangents count, in which both are equally high: the ends of the curve. *)
Theorem tangents_suffice N B i j : (i < N)%nat -> (j < N)%nat ->
  (possible N B i j <-> (exists c, ds c (B i) = ds c (B j) /\ forall k, (k < N)%nat -> k <> i -> k <> j -> ~ blocks c
    (B i) (B k)) \/
    (exists u, possible_far N B (pair i j) u /\ dot u (highest u (B i)) = dot u (highest u (B j)))).
Proof.
  intros I J. rewrite (possible_unblocked N B i j I J). split; intros [H | H]; try (now left).
  - destruct H as [u H]. destruct (Rtotal_order (dot u (highest u (B i))) (dot u (highest u (B j)))) as [L | [E | L]].
    + left. destruct (higher_has_centre N B j i u J I) as [c [E O]]; [| exact L |].
      { destruct H as [U H]. split; [exact U |]. intros m k M S. apply H; [exact M |]. destruct S;
        [now right | now left]. }
      exists c. split; [now symmetry |]. intros k K _ _ Bl. unfold blocks in Bl. specialize (O k K). lra.
    + right. now exists u.
    + left. destruct (higher_has_centre N B i j u I J H L) as [c [E O]]. exists c. split; [exact E |].
      intros k K _ _ Bl. unfold blocks in Bl. specialize (O k K). lra.
  - destruct H as [u [H _]]. right. now exists u.
Qed.

(* Who meets one of the two blocks nothing. *)
Theorem meeting_blocks_nothing c X Y K z : ds c X = ds c Y -> inside z K -> inside z X \/ inside z Y -> ~ blocks c X K.
Proof.
  unfold blocks. intros E Z [H | H] Bl; pose proof (le_dl c K z Z); pose proof (ds_le c _ z H); lra.
Qed.

(* The set of blocked places is open; at its ends the three distances are equal: the centre of a critical circle CCF. *)
Theorem blocked_open c X K : blocks c X K -> exists e, 0 < e /\ forall x, dist c x < e -> blocks x X K.
Proof.
  unfold blocks. intros H. exists ((ds c X - dl c K) / 2). split; [lra |]. intros x D.
  pose proof (dl_move x c K). pose proof (ds_move c x X). rewrite (dist_sym x c) in *. lra.
Qed.

Theorem edge_of_blocked c X K : ~ blocks c X K -> (forall e, 0 < e -> exists x, dist c x < e /\ blocks x X K) -> dl c
  K = ds c X.
Proof.
  unfold blocks. intros H A. destruct (Req_dec (dl c K) (ds c X)) as [E | E]; [exact E | exfalso].
  destruct (A ((dl c K - ds c X) / 2)) as [x [D L]]; [lra |].
  pose proof (dl_move c x K). pose proof (ds_move x c X). rewrite (dist_sym x c) in *. lra.
Qed.

(* Intervals each of which meets the next cover all between their first and their last place. *)
Definition interval (S : R -> Prop) : Prop := forall a b t, S a -> S b -> a <= t <= b -> S t.

Theorem chain_covers (S : nat -> R -> Prop) n : (forall m, (m <= n)%nat -> interval (S m)) ->
  (forall m, (m < n)%nat -> exists x, S m x /\ S (Datatypes.S m) x) ->
  forall a b t, S 0%nat a -> S n b -> a <= t <= b \/ b <= t <= a -> exists m, (m <= n)%nat /\ S m t.
Proof.
  induction n as [| n IH]; intros C M a b t A E T.
  - exists 0%nat. split; [lia |]. destruct T; [now apply (C 0%nat (le_n _) a b) | now apply (C 0%nat (le_n _) b a)].
  - destruct (M n (Nat.lt_succ_diag_r n)) as [x [X X']].
    assert (D : (a <= t <= x \/ x <= t <= a) \/ (x <= t <= b \/ b <= t <= x)) by lra.
    destruct D as [D | D].
    + destruct (IH (fun m L => C m (le_S _ _ L)) (fun m L => M m (Nat.lt_lt_succ_r _ _ L)) a x t A X D) as [m [L Q]].
      exists m. split; [lia | exact Q].
    + exists (Datatypes.S n). split; [lia |]. destruct D; [now apply (C _ (le_n _) x b) | now apply (C _ (le_n _) b x)].
Qed.
