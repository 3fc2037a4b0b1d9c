(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Only possible neighbours bound the partial cells. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells.
Open Scope R_scope.

(* c shows that i and j can be neighbours: it lies in Pos of both. *)
Definition neighbours_at (N : nat) (B : sites) (i j : nat) (c : point) : Prop := pos N B i c /\ pos N B j c.
Definition neighbours (N : nat) (B : sites) (i j : nat) : Prop := exists c, neighbours_at N B i j c.

Section Way.
(* On the straight way from c to the nearest point of R_i, ds_i falls as fast as one goes. *)
Variables (B : sites) (i : nat) (c : point).
Definition way (t : R) : point := mix t c (nearest c (B i)).

Lemma way_0 : way 0 = c.
Proof. apply mix_0. Qed.

Lemma way_ds t : 0 <= t <= 1 -> ds (way t) (B i) = (1 - t) * ds c (B i).
Proof. apply ds_towards. Qed.

(* Each site that blocks at some place of the way has blocked all the way to it. *)
Lemma blocked_before k s t : 0 <= s <= t -> t <= 1 ->
  dl (way t) (B k) < ds (way t) (B i) -> dl (way s) (B k) < ds (way s) (B i).
Proof.
  intros S T H. rewrite way_ds in * by lra. pose proof (dl_move (way s) (way t) (B k)) as M.
  unfold way in M at 2 3. rewrite dist_mix_mix, Rabs_minus_sym, Rabs_pos_eq in M by lra.
  change (dist c (nearest c (B i))) with (ds c (B i)) in M. fold (way t) in M. lra.
Qed.

(* A blocker stops blocking at some place of the way. *)
Lemma blocker_ends k : dl c (B k) < ds c (B i) ->
  exists t, 0 <= t <= 1 /\ dl (way t) (B k) = ds (way t) (B i).
Proof.
  intros H. set (f t := dl (way t) (B k) - (1 - t) * ds c (B i)).
  destruct (intermediate f) as [t [T E]].
  - apply (lipschitz_continuous (ds c (B i) + ds c (B i))). apply lipschitz_minus.
    + intros s t. pose proof (dl_move (way s) (way t) (B k)) as M. unfold way in M at 2 3. rewrite dist_mix_mix in M.
      change (dist c (nearest c (B i))) with (ds c (B i)) in M. lra.
    + apply lipschitz_scale, ds_nonneg.
  - unfold f, way. rewrite mix_0. lra.
  - unfold f. pose proof (dl_nonneg (way 1) (B k)). lra.
  - exists t. split; [exact T |]. rewrite way_ds by exact T. unfold f in E. lra.
Qed.
End Way.

(* If c is not in Pos_i, then on the way to R_i there is a place where Pos_i begins, on the boundary of C_ji for a
   neighbour j that blocks c itself. *)
Theorem way_into_pos N B i c : (i < N)%nat -> ~ pos N B i c ->
  exists t j, 0 <= t <= 1 /\ (j < N)%nat /\ j <> i /\ dl c (B j) < ds c (B i) /\
    pos N B i (way B i c t) /\ dl (way B i c t) (B j) = ds (way B i c t) (B i) /\
    neighbours_at N B i j (way B i c t).
Proof.
  intros I H. set (blocks k := dl c (B k) < ds c (B i)).
  set (ends k t := 0 <= t <= 1 /\ (blocks k -> dl (way B i c t) (B k) = ds (way B i c t) (B i))).
  destruct (finite_choice 0 ends N) as [t T].
  { intros k _. destruct (classic (blocks k)) as [Y | Y].
    - destruct (blocker_ends B i c k Y) as [t [T E]]. exists t. now split.
    - exists 0. split; [lra |]. now intros. }
  destruct (finite_max blocks t N) as [j [J [Bj L]]].
  { apply ext_complement_of_pos in H as [k [K [_ G]]]. now exists k. }
  destruct (T j J) as [Tj Ej]. specialize (Ej Bj).
  assert (P : pos N B i (way B i c (t j))).
  { intros k K. apply Rnot_lt_le. intros C.
    assert (Bk : blocks k).
    { pose proof (blocked_before B i c k 0 (t j)) as X. rewrite way_0 in X. apply X; [split; lra | lra | exact C]. }
    destruct (T k K) as [Tk Ek]. specialize (Ek Bk). pose proof (L k K Bk).
    pose proof (blocked_before B i c k (t k) (t j)). lra. }
  exists (t j), j. repeat split; try lra; try assumption.
  - intros ->. pose proof (ds_le_dl c (B i)). unfold blocks in Bj. lra.
  - intros k K. pose proof (P k K). pose proof (ds_le_dl (way B i c (t j)) (B j)). lra.
Qed.

(* Membership in Pos_i is decided by the possible neighbours of i alone ... *)
Theorem pos_by_neighbours N B i c : (i < N)%nat ->
  (forall j, (j < N)%nat -> j <> i -> neighbours N B i j -> ds c (B i) <= dl c (B j)) -> pos N B i c.
Proof.
  intros I H. apply NNPP. intros C. destruct (way_into_pos N B i c I C) as [t [j [_ [J [D [L [_ [_ G]]]]]]]].
  assert (ds c (B i) <= dl c (B j)) by (apply H; [exact J | exact D | exists (way B i c t); exact G]). lra.
Qed.

(* ... and so is membership in Int_i. *)
Theorem int_by_neighbours N B i c : (i < N)%nat ->
  (forall j, (j < N)%nat -> j <> i -> neighbours N B i j -> dl c (B i) < ds c (B j)) -> int N B i c.
Proof.
  intros I H.
  assert (P : pos N B i c).
  { apply pos_by_neighbours; [exact I |]. intros j J D G. pose proof (H j J D G).
    pose proof (ds_le_dl c (B i)). pose proof (ds_le_dl c (B j)). lra. }
  apply NNPP. intros C. apply not_all_ex_not in C as [k C]. apply imply_to_and in C as [K C].
  apply imply_to_and in C as [D C].
  destruct (finite_min (fun k => k <> i) (fun k => ds c (B k)) N) as [j [J [Dj L]]]; [now exists k |].
  pose proof (L k K D).
  assert (G : neighbours N B i j).
  { exists c. split; [exact P |]. intros m M. destruct (Nat.eq_dec m i) as [-> | Dm]; [lra |].
    pose proof (L m M Dm). pose proof (ds_le_dl c (B m)). lra. }
  pose proof (H j J Dj G). lra.
Qed.

(* At the boundary of Int_i (outside it, but as near as one likes to points of it) a possible neighbour j has
   dl_i = ds_j, and no other site is nearer. *)
Theorem int_boundary N B i c : (i < N)%nat -> ~ int N B i c ->
  (forall e, 0 < e -> exists x, dist c x <= e /\ int N B i x) ->
  exists j, (j < N)%nat /\ j <> i /\ dl c (B i) = ds c (B j) /\ neighbours_at N B i j c.
Proof.
  intros I O A.
  assert (W : forall k, (k < N)%nat -> k <> i -> dl c (B i) <= ds c (B k)).
  { intros k K D. apply Rnot_lt_le. intros L. set (e := (dl c (B i) - ds c (B k)) / 3).
    destruct (A e) as [x [X H]]; [unfold e; lra |]. pose proof (H k K D).
    pose proof (dl_move c x (B i)). pose proof (ds_move x c (B k)). rewrite (dist_sym x c) in *. unfold e in X. lra. }
  apply not_all_ex_not in O as [j O]. apply imply_to_and in O as [J O]. apply imply_to_and in O as [D O].
  exists j. pose proof (W j J D). assert (E : dl c (B i) = ds c (B j)) by lra.
  repeat split; [exact J | exact D | exact E | |]; intros k K; pose proof (ds_le_dl c (B i)); pose proof (ds_le_dl c (B k));
    (destruct (Nat.eq_dec k i) as [-> | Dk]; [| pose proof (W k K Dk)]; lra).
Qed.
