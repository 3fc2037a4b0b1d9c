(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The partial Voronoi cells are exactly the intersection and the union of the true cells.
   Sites are numbered 0 .. N-1; B gives their rectangles. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance.
Open Scope R_scope.

Definition sites : Type := nat -> rect.

(* One point in each rectangle. *)
Definition choice (N : nat) (B : sites) (p : nat -> point) : Prop :=
  forall k, (k < N)%nat -> inside (p k) (B k).

(* B' has at least the information of B. *)
Definition refined (N : nat) (B' B : sites) : Prop := forall k, (k < N)%nat -> refines (B' k) (B k).

(* The closed and the open Voronoi cell of the point p i. *)
Definition cell (N : nat) (p : nat -> point) (i : nat) (c : point) : Prop :=
  forall k, (k < N)%nat -> dist c (p i) <= dist c (p k).
Definition open_cell (N : nat) (p : nat -> point) (i : nat) (c : point) : Prop :=
  forall k, (k < N)%nat -> k <> i -> dist c (p i) < dist c (p k).

(* Int, Pos and Ext (mathematics: section 2): surely nearest, possibly nearest, surely not nearest. *)
Definition int (N : nat) (B : sites) (i : nat) (c : point) : Prop :=
  forall j, (j < N)%nat -> j <> i -> dl c (B i) < ds c (B j).
Definition pos (N : nat) (B : sites) (i : nat) (c : point) : Prop :=
  forall k, (k < N)%nat -> ds c (B i) <= dl c (B k).
Definition ext (N : nat) (B : sites) (i : nat) (c : point) : Prop :=
  exists j, (j < N)%nat /\ j <> i /\ dl c (B j) < ds c (B i).

(* Exchanges one point of a choice. *)
Definition set_point (p : nat -> point) (i : nat) (z : point) (k : nat) : point :=
  if Nat.eq_dec k i then z else p k.

Lemma set_same p i z : set_point p i z i = z.
Proof. unfold set_point. now destruct (Nat.eq_dec i i). Qed.

Lemma set_other p i z k : k <> i -> set_point p i z k = p k.
Proof. intros H. unfold set_point. now destruct (Nat.eq_dec k i). Qed.

Lemma set_choice N B p i z : choice N B p -> inside z (B i) -> choice N B (set_point p i z).
Proof.
  intros P Z k K. destruct (Nat.eq_dec k i) as [-> | D]; [now rewrite set_same | rewrite set_other by exact D; now apply P].
Qed.

Lemma choice_nearest N B c : choice N B (fun k => nearest c (B k)).
Proof. intros k _. apply nearest_inside. Qed.

Lemma choice_farthest N B c : choice N B (fun k => farthest c (B k)).
Proof. intros k _. apply farthest_inside. Qed.

(* Int is the intersection of the open cells over all choices. *)
Theorem int_exact N B i c : (i < N)%nat ->
  (int N B i c <-> forall p, choice N B p -> open_cell N p i c).
Proof.
  intros I. split.
  - intros H p P k K D. pose proof (le_dl c _ _ (P i I)). pose proof (ds_le c _ _ (P k K)). pose proof (H k K D). lra.
  - intros H j J D. set (p := set_point (fun k => nearest c (B k)) i (farthest c (B i))).
    assert (P : choice N B p) by (apply set_choice; [apply choice_nearest | apply farthest_inside]).
    pose proof (H p P j J D) as G. unfold p in G. rewrite set_same, set_other in G by exact D. exact G.
Qed.

(* Pos is the union of the closed cells over all choices. *)
Theorem pos_exact N B i c : (i < N)%nat ->
  (pos N B i c <-> exists p, choice N B p /\ cell N p i c).
Proof.
  intros I. split.
  - intros H. set (p := set_point (fun k => farthest c (B k)) i (nearest c (B i))). exists p.
    split; [apply set_choice; [apply choice_farthest | apply nearest_inside] |].
    intros k K. unfold p. rewrite set_same. destruct (Nat.eq_dec k i) as [-> | D].
    + rewrite set_same. lra.
    + rewrite set_other by exact D. now apply H.
  - intros [p [P H]] k K. pose proof (ds_le c _ _ (P i I)). pose proof (le_dl c _ _ (P k K)). pose proof (H k K). lra.
Qed.

Theorem ext_complement_of_pos N B i c : ext N B i c <-> ~ pos N B i c.
Proof.
  split.
  - intros [j [J [_ L]]] H. pose proof (H j J). lra.
  - intros H. apply not_all_ex_not in H as [j H]. apply imply_to_and in H as [J L]. exists j.
    split; [exact J |]. split; [| lra]. intros ->. pose proof (ds_le_dl c (B i)). lra.
Qed.

(* A certainly nearest site is possibly nearest; a site that is certainly not nearest is neither. *)
Theorem int_in_pos N B i c : int N B i c -> pos N B i c.
Proof.
  intros H k K. destruct (Nat.eq_dec k i) as [-> | D]; [apply ds_le_dl |].
  pose proof (H k K D). pose proof (ds_le_dl c (B i)). pose proof (ds_le_dl c (B k)). lra.
Qed.

Theorem int_disjoint N B i j c : (i < N)%nat -> (j < N)%nat -> i <> j -> int N B i c -> ~ int N B j c.
Proof.
  intros I J D H G. pose proof (H j J (not_eq_sym D)). pose proof (G i I D).
  pose proof (ds_le_dl c (B i)). pose proof (ds_le_dl c (B j)). lra.
Qed.

(* The cells Pos cover the plane. *)
Theorem pos_cover N B c : (0 < N)%nat -> exists i, (i < N)%nat /\ pos N B i c.
Proof.
  intros H. destruct (finite_min (fun _ => True) (fun k => ds c (B k)) N) as [i [I [_ L]]]; [now exists 0%nat |].
  exists i. split; [exact I |]. intros k K. pose proof (L k K Logic.I). pose proof (ds_le_dl c (B k)). lra.
Qed.

Theorem int_convex N B i a b t : 0 <= t <= 1 -> int N B i a -> int N B i b -> int N B i (mix t a b).
Proof.
  intros T A H j J D. apply nearer_convex; [exact T | |].
  - pose proof (A j J D). pose proof (le_dl a _ _ (farthest_inside (mix t a b) (B i))).
    pose proof (ds_le a _ _ (nearest_inside (mix t a b) (B j))). lra.
  - pose proof (H j J D). pose proof (le_dl b _ _ (farthest_inside (mix t a b) (B i))).
    pose proof (ds_le b _ _ (nearest_inside (mix t a b) (B j))). lra.
Qed.

Lemma less_open u v : u < v -> small (fun d => u + d < v - d).
Proof. intros H. exists ((v - u) / 3). split; intros; lra. Qed.

Theorem int_open N B i c : int N B i c -> exists e, 0 < e /\ forall x, dist c x <= e -> int N B i x.
Proof.
  intros H. destruct (small_finite (fun j d => j <> i -> dl c (B i) + d < ds c (B j) - d) N) as [e [E L]].
  { intros j J. destruct (Nat.eq_dec j i) as [-> | D].
    - exists 1. split; [lra |]. now intros.
    - pose proof (less_open _ _ (H j J D)) as S. revert S. apply small_weaken. now intros. }
  exists e. split; [exact E |]. intros x X j J D.
  pose proof (L e (conj E (Rle_refl e)) j J D). pose proof (dl_move x c (B i)). pose proof (ds_move c x (B j)).
  rewrite (dist_sym x c) in *. lra.
Qed.

Theorem ext_open N B i c : ext N B i c -> exists e, 0 < e /\ forall x, dist c x <= e -> ext N B i x.
Proof.
  intros [j [J [D L]]]. destruct (less_open _ _ L) as [e [E G]]. exists e. split; [exact E |].
  intros x X. exists j. repeat split; [exact J | exact D |]. specialize (G e (conj E (Rle_refl e))).
  pose proof (dl_move x c (B j)). pose proof (ds_move c x (B i)). rewrite (dist_sym x c) in *. lra.
Qed.

(* Pos is star-shaped towards the rectangle: with c the segment to the point of the rectangle nearest to c. *)
Theorem pos_star N B i c t : 0 <= t <= 1 -> pos N B i c -> pos N B i (mix t c (nearest c (B i))).
Proof.
  intros T H k K. rewrite ds_towards by exact T. pose proof (H k K).
  pose proof (dl_move c (mix t c (nearest c (B i))) (B k)) as M. rewrite dist_mix_left in M by lra.
  change (dist c (nearest c (B i))) with (ds c (B i)) in M. lra.
Qed.

(* Finer rectangles retract nothing. *)
Theorem int_monotone N B' B i c : (i < N)%nat -> refined N B' B -> int N B i c -> int N B' i c.
Proof.
  intros I F H j J D. pose proof (H j J D). pose proof (dl_monotone c _ _ (F i I)). pose proof (ds_monotone c _ _ (F j J)).
  lra.
Qed.

Theorem ext_monotone N B' B i c : (i < N)%nat -> refined N B' B -> ext N B i c -> ext N B' i c.
Proof.
  intros I F [j [J [D L]]]. exists j. repeat split; [exact J | exact D |].
  pose proof (dl_monotone c _ _ (F j J)). pose proof (ds_monotone c _ _ (F i I)). lra.
Qed.

Theorem pos_monotone N B' B i c : (i < N)%nat -> refined N B' B -> pos N B' i c -> pos N B i c.
Proof.
  intros I F H k K. pose proof (H k K). pose proof (dl_monotone c _ _ (F k K)). pose proof (ds_monotone c _ _ (F i I)). lra.
Qed.
