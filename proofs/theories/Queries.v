(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Queries for the nearest sites of a place that is known to a rectangle q [NEAR-1] [NEAR-3] [NEAR-4]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells.
Open Scope R_scope.

(* q meets Pos_i; q is inside Int_i. *)
Definition listed (N : nat) (B : sites) (q : rect) (i : nat) : Prop := exists c, inside c q /\ pos N B i c.
Definition surely_nearest (N : nat) (B : sites) (q : rect) (i : nat) : Prop := forall c, inside c q -> int N B i c.

(* A listed site is nearest for some choice and some place; a certainly nearest one is so for all of them. *)
Theorem listed_exact N B q i : (i < N)%nat ->
  (listed N B q i <-> exists c p, inside c q /\ choice N B p /\ cell N p i c).
Proof.
  intros I. split.
  - intros [c [C P]]. apply (pos_exact N B i c I) in P. destruct P as [p P]. exists c, p. tauto.
  - intros [c [p [C P]]]. exists c. split; [exact C |]. apply (pos_exact N B i c I). now exists p.
Qed.

Theorem sure_exact N B q i : (i < N)%nat ->
  (surely_nearest N B q i <-> forall c p, inside c q -> choice N B p -> open_cell N p i c).
Proof.
  intros I. split.
  - intros H c p C. apply (proj1 (int_exact N B i c I) (H c C)).
  - intros H c C. apply (int_exact N B i c I). intros p. now apply H.
Qed.

(* One site is listed iff it is surely nearest. *)
Theorem only_listed N B q i : (i < N)%nat ->
  (surely_nearest N B q i <-> forall k, (k < N)%nat -> (listed N B q k <-> k = i)).
Proof.
  intros I. split.
  - intros H k K. split.
    + intros [c [C P]]. destruct (Nat.eq_dec k i) as [E | D]; [exact E |]. pose proof (H c C k K D). pose proof (P i I). lra.
    + intros ->. exists (nearest (0, 0) q). split; [apply nearest_inside |]. apply int_in_pos, H, nearest_inside.
  - intros H c C j J D. destruct (finite_min (fun _ => True) (fun k => dl c (B k)) N) as [m [M [_ L]]]; [now exists i |].
    assert (E : m = i).
    { apply (H m M). exists c. split; [exact C |]. intros k K. pose proof (L k K Logic.I). pose proof (ds_le_dl c (B m)). lra. }
    subst m. apply Rnot_le_lt. intros F. apply D, (H j J). exists c. split; [exact C |].
    intros k K. pose proof (L k K Logic.I). lra.
Qed.

(* Candidates: a set that holds all listed sites decides. *)
Theorem candidates_decide N B q S i c : (i < N)%nat -> inside c q -> (forall k, (k < N)%nat -> listed N B q k -> S k) ->
  (pos N B i c <-> forall k, (k < N)%nat -> S k -> ds c (B i) <= dl c (B k)).
Proof.
  intros I C H. split; [intros P k K _; now apply P |]. intros P k K.
  destruct (finite_min (fun _ => True) (fun k => dl c (B k)) N) as [m [M [_ L]]]; [now exists i |].
  pose proof (L k K Logic.I). assert (X : listed N B q m).
  { exists c. split; [exact C |]. intros l Hl. pose proof (L l Hl Logic.I). pose proof (ds_le_dl c (B m)). lra. }
  pose proof (P m M (H m M X)). lra.
Qed.

(* Each listed site is within the least of the bounds for all of q. *)
Theorem candidate_near N B q i m b : (m < N)%nat -> (forall c, inside c q -> dl c (B m) <= b) -> listed N B q i ->
  exists c, inside c q /\ ds c (B i) <= b.
Proof. intros M L [c [C P]]. exists c. split; [exact C |]. pose proof (P m M). pose proof (L c C). lra. Qed.

(* All true nearest points are listed; *)
Theorem nearest_are_listed N B q p x i : (i < N)%nat -> choice N B p -> inside x q -> cell N p i x -> listed N B q i.
Proof. intros I P X C. apply listed_exact; [exact I |]. now exists x, p. Qed.

(* narrower rectangles, of the sites and of the place, list no more; *)
Theorem list_shrinks N B' B q' q i : (i < N)%nat -> refined N B' B -> refines q' q -> listed N B' q' i -> listed N B q i.
Proof. intros I F G [c [C P]]. exists c. split; [now apply G | now apply (pos_monotone N B' B)]. Qed.

(* nor do they take back a certainly nearest site; *)
Theorem sure_stays N B' B q' q i : (i < N)%nat -> refined N B' B -> refines q' q ->
  surely_nearest N B q i -> surely_nearest N B' q' i.
Proof. intros I F G H c C. apply (int_monotone N B' B); [exact I | exact F |]. now apply H, G. Qed.

(* and a site that is not listed need not be narrowed: it stays off, whichever of the others are. *)
Theorem off_stays_off N B' B q' q i : (i < N)%nat -> (forall k, (k < N)%nat -> B' k = B k \/ refines (B' k) (B k)) ->
  refines q' q -> ~ listed N B q i -> ~ listed N B' q' i.
Proof.
  intros I F G H L. apply H. apply (list_shrinks N B' B q' q i I); [| exact G | exact L].
  intros k K. destruct (F k K) as [-> | R]; [now intros z | exact R].
Qed.

(* A tie: where all that are listed are equally far from the true place, the nearest sites are exactly these. *)
Theorem equally_far_are_nearest N B q p x : choice N B p -> inside x q ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> listed N B q i -> listed N B q j -> dist x (p i) = dist x (p j)) ->
  forall i, (i < N)%nat -> (listed N B q i <-> cell N p i x).
Proof.
  intros P X E i I. split; [| now apply nearest_are_listed].
  intros L. destruct (finite_min (fun _ => True) (fun k => dist x (p k)) N) as [m [M [_ H]]]; [now exists i |].
  assert (Lm : listed N B q m) by (apply (nearest_are_listed N B q p x m M P X); intros k K; now apply H).
  intros k K. rewrite (E i m I M L Lm). now apply H.
Qed.

(* It stays so, whatever is refined: the nearest sites remain listed. *)
Theorem tie_stays N B' B q' q p x : (forall k, (k < N)%nat -> refines (B' k) (B k)) -> refines q' q ->
  choice N B' p -> inside x q' ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> listed N B q i -> listed N B q j -> dist x (p i) = dist x (p j)) ->
  forall i, (i < N)%nat -> (listed N B q i <-> listed N B' q' i).
Proof.
  intros F G P X E i I.
  assert (P0 : choice N B p) by (intros k K; now apply F, P).
  split; intros L.
  - apply (nearest_are_listed N B' q' p x i I P X). apply (equally_far_are_nearest N B q p x P0 (G x X) E i I). exact L.
  - now apply (list_shrinks N B' B q' q i I).
Qed.

(* Of exact points about an exact place the listed ones are equally far. *)
Theorem exact_listed N B q p x : (forall k, (k < N)%nat -> inside (p k) (B k) /\ forall z, inside z (B k) -> z = p k) ->
  (forall c, inside c q -> c = x) ->
  forall i j, (i < N)%nat -> (j < N)%nat -> listed N B q i -> listed N B q j -> dist x (p i) = dist x (p j).
Proof.
  intros E Q i j I J [c [C L]] [c' [C' L']]. apply Q in C, C'. subst c c'. specialize (L j J). specialize (L' i I).
  unfold ds, dl in L, L'. rewrite (proj2 (E i I) _ (nearest_inside _ _)), (proj2 (E j J) _ (farthest_inside _ _)) in L.
  rewrite (proj2 (E j J) _ (nearest_inside _ _)), (proj2 (E i I) _ (farthest_inside _ _)) in L'. lra.
Qed.
