(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Tied chains [TIE-3]: neighbours are legal, and the true points are on one line. They lie on it in their order, and no
   two that are not neighbours are strictly Delaunay. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Path Fan.
Open Scope R_scope.

Section Chain.
(* v 0 .. v (m - 1): the chain; q: the true points. *)
Variables (N : nat) (B : sites) (q : nat -> point) (v : nat -> nat) (m : nat).
Variable true_points : choice N B q.
Variable three : (3 <= m)%nat.
Variable below : forall k, (k < m)%nat -> (v k < N)%nat.
Variable distinct : forall i j, (i < m)%nat -> (j < m)%nat -> v i = v j -> i = j.
Variable link : forall k, (S k < m)%nat -> legal N B (v k) (v (S k)).
Variable line : forall i j k, (i < m)%nat -> (j < m)%nat -> (k < m)%nat ->
  orient (q (v i)) (q (v j)) (q (v k)) = 0.

Lemma link_is_free k l : (S k < m)%nat -> (l < m)%nat -> l <> k -> l <> S k ->
  ~ between (q (v l)) (q (v k)) (q (v (S k))).
Proof.
  intros K L Dk Ds. apply (edge_is_free N q (v k) (v (S k)) (v l)).
  - now apply below.
  - intros E. apply Dk, distinct; [exact L | lia | exact E].
  - intros E. apply Ds, distinct; [exact L | lia | exact E].
  - apply (legal_sound N B); [apply below; lia | now apply below | now apply link | exact true_points].
Qed.

Lemma between_ends a b : between a a b /\ between b a b.
Proof. split; [exists 0; rewrite mix_0 | exists 1; rewrite mix_1]; split; auto; lra. Qed.

Lemma links_have_length k : (S k < m)%nat -> q (v k) <> q (v (S k)).
Proof.
  intros K E. destruct k as [| k].
  - apply (link_is_free 1 0); try lia. rewrite E. apply between_ends.
  - apply (link_is_free k (S (S k))); try lia. rewrite <- E. apply between_ends.
Qed.

Lemma inner_between k : (S (S k) < m)%nat -> between (q (v (S k))) (q (v k)) (q (v (S (S k)))).
Proof.
  intros K. destruct (one_between (q (v k)) (q (v (S k))) (q (v (S (S k))))) as [H | [H | H]];
    [apply line; lia | exfalso | exact H | exfalso].
  - revert H. apply link_is_free; lia.
  - revert H. apply link_is_free; lia.
Qed.

(* How far along the line. *)
Definition way : point := (fst (q (v 1)) - fst (q (v 0)), snd (q (v 1)) - snd (q (v 0))).
Definition far (k : nat) : R := dot way (q (v k)).

Lemma step_on k : (S k < m)%nat -> far k < far (S k).
Proof.
  induction k as [| k IH]; intros K.
  - assert (D : 0 < dist2 (q (v 0)) (q (v 1))).
    { rewrite <- dist_sq. pose proof (dist_pos _ _ (links_have_length 0 K)). now apply Rmult_lt_0_compat. }
    assert (E : far 1 - far 0 = dist2 (q (v 0)) (q (v 1))) by (unfold far, way, dot, dist2; simpl; ring). lra.
  - specialize (IH ltac:(lia)). destruct (inner_between k K) as [t [S Z]].
    assert (T0 : t <> 0).
    { intros ->. rewrite mix_0 in Z. now apply (links_have_length k ltac:(lia)). }
    assert (T1 : t <> 1) by (intros ->; rewrite mix_1 in Z; now apply (links_have_length (Datatypes.S k) K)).
    assert (E : far (Datatypes.S k) = (1 - t) * far k + t * far (Datatypes.S (Datatypes.S k)))
      by (unfold far; rewrite Z; apply dot_mix).
    assert (0 < (1 - t) * (far (Datatypes.S k) - far k)) by (apply Rmult_lt_0_compat; lra).
    apply (Rmult_lt_reg_l t); lra.
Qed.

Theorem chain_in_order i j : (i < j)%nat -> (j < m)%nat -> far i < far j.
Proof.
  induction j as [| j IH]; intros L J; [lia |]. pose proof (step_on j J).
  destruct (Nat.eq_dec i j) as [-> | D]; [assumption |]. specialize (IH ltac:(lia) ltac:(lia)). lra.
Qed.

Theorem chain_not_strict i j : (S i < j)%nat -> (j < m)%nat ->
  ~ strict_edge N q (v i) (v j) /\ ~ strict_edge N q (v j) (v i).
Proof.
  intros L J. pose proof (step_on i ltac:(lia)) as A. pose proof (chain_in_order (S i) j L J) as C.
  assert (Bt : between (q (v (S i))) (q (v i)) (q (v j))).
  { assert (Mix : forall a b c, between (q (v a)) (q (v b)) (q (v c)) ->
      exists t, 0 <= t <= 1 /\ far a = (1 - t) * far b + t * far c).
    { intros a b c [t [T Z]]. exists t. split; [exact T |]. unfold far. rewrite Z. apply dot_mix. }
    destruct (one_between (q (v i)) (q (v (S i))) (q (v j))) as [H | [H | H]]; [apply line; lia | exfalso | | exfalso].
    - destruct (Mix _ _ _ H) as [t [T Z]].
      assert (0 <= (1 - t) * (far (S i) - far i)) by (apply Rmult_le_pos; lra).
      assert (0 <= t * (far j - far i)) by (apply Rmult_le_pos; lra).
      destruct (Req_dec t 0) as [-> | T0]; [lra |].
      assert (0 < t * (far j - far i)) by (apply Rmult_lt_0_compat; lra). lra.
    - exact H.
    - destruct (Mix _ _ _ H) as [t [T Z]].
      assert (0 <= (1 - t) * (far j - far i)) by (apply Rmult_le_pos; lra).
      assert (0 <= t * (far j - far (S i))) by (apply Rmult_le_pos; lra).
      destruct (Req_dec t 0) as [-> | T0]; [lra |].
      assert (0 < t * (far j - far (S i))) by (apply Rmult_lt_0_compat; lra). lra. }
  assert (D : v (S i) <> v i /\ v (S i) <> v j).
  { split; intros E; apply distinct in E; lia. }
  split; intros H.
  - now apply (edge_is_free N q (v i) (v j) (v (S i)) (below (S i) ltac:(lia)) (proj1 D) (proj2 D) H).
  - apply (edge_is_free N q (v j) (v i) (v (S i)) (below (S i) ltac:(lia)) (proj2 D) (proj1 D) H).
    destruct Bt as [t [T Z]]. exists (1 - t). split; [lra |]. now rewrite <- mix_swap.
Qed.
End Chain.
