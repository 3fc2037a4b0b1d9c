(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Who blocks a centre of the curve on which two rectangles are equally far [COV-1] [COV-2]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Nerve Curve Disc.
Open Scope R_scope.

(* k blocks c: every point of R_k is nearer to c than R_i. *)
Definition blocks (c : point) (X K : rect) : Prop := dl c K < ds c X.

(* The pair is possible iff a centre at equal distances, or a direction, is blocked by nobody. *)
Theorem possible_unblocked N B i j : (i < N)%nat -> (j < N)%nat ->
  (possible N B i j <-> (exists c, ds c (B i) = ds c (B j) /\ forall k, (k < N)%nat -> k <> i -> k <> j -> ~ blocks c (B i) (B k)) \/
    (exists u, possible_far N B (pair i j) u)).
Proof.
  intros I J. unfold possible. split; (intros [H | H]; [left | now right]).
  - destruct (equal_distances_suffice N B i j I J H) as [c [E O]]. exists c. split; [exact E |].
    intros k K Di Dj Bl. unfold blocks in Bl. destruct (O k K Di Dj). lra.
  - destruct H as [c [E O]]. exists c. intros k K Di Dj. specialize (O k K Di Dj). unfold blocks in O. split; lra.
Qed.

(* Who meets one of the two blocks nothing. *)
Theorem meeting_blocks_nothing c X Y K z : ds c X = ds c Y -> inside z K -> inside z X \/ inside z Y -> ~ blocks c X K.
Proof.
  unfold blocks. intros E Z [H | H] Bl; pose proof (le_dl c K z Z); pose proof (ds_le c _ z H); lra.
Qed.

(* What is blocked is open, and at its ends the three distances are equal: the centre of a critical circle CCF. *)
Theorem blocked_open c X K : blocks c X K -> exists e, 0 < e /\ forall x, dist c x < e -> blocks x X K.
Proof.
  unfold blocks. intros H. exists ((ds c X - dl c K) / 2). split; [lra |]. intros x D.
  pose proof (dl_move x c K). pose proof (ds_move c x X). rewrite (dist_sym x c) in *. lra.
Qed.

Theorem edge_of_blocked c X K : ~ blocks c X K -> (forall e, 0 < e -> exists x, dist c x < e /\ blocks x X K) -> dl c K = ds c X.
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
