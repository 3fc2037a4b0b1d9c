(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The part next to an edge that a fat rectangle meets: the disc of the witness lies in the two discs, or in the disc
   and the half-plane, next to the edge [WIT-FAT]. *)
From Coq Require Import Reals Lra Psatz Classical.
From Dyadel Require Import Plane Distance Orientation TiedFace.
Open Scope R_scope.

(* The disc about the middle of two centres through p is within their two discs through p. *)
Theorem middle_disc_covered o w p z : dist (mix (/ 2) o w) z <= dist (mix (/ 2) o w) p ->
  dist o z <= dist o p \/ dist w z <= dist w p.
Proof.
  intros H. apply dist_le in H. pose proof (power_mix (/ 2) o w z p).
  destruct (Rle_dec (dist2 o z) (dist2 o p)) as [L | L]; [left | right]; apply dist_le; lra.
Qed.

(* At the hull: the centre goes outward from o, t times the outward vector of the edge from p to q. *)
Theorem hull_disc_covered o p q t z : 0 <= t ->
  let c := (fst o + t * (snd q - snd p), snd o - t * (fst q - fst p)) in
  dist c z <= dist c p -> dist o z <= dist o p \/ orient p q z <= 0.
Proof.
  intros T c H. apply dist_le in H.
  assert (E : dist2 c z - dist2 c p = dist2 o z - dist2 o p + 2 * t * orient p q z)
    by (unfold c, dist2, orient; simpl; ring).
  destruct (Rle_dec (dist2 o z) (dist2 o p)) as [L | L]; [left; now apply dist_le | right].
  apply Rnot_lt_le. intros O. assert (0 <= t * orient p q z) by (apply Rmult_le_pos; lra). lra.
Qed.

(* A point within e of the disc is within e of one of the two; *)
Lemma near_disc c r e x : 0 <= r -> 0 <= e -> dist c x <= r + e -> exists z, dist c z <= r /\ dist z x <= e.
Proof.
  intros R E H. destruct (Rle_dec (dist c x) r) as [L | L]; [exists x; rewrite dist_self; lra |].
  assert (D : 0 < dist c x) by lra. set (t := r / dist c x).
  assert (Et : t * dist c x = r) by (unfold t; field; lra).
  assert (T0 : 0 <= t) by (unfold t; apply Rmult_le_pos; [exact R | left; now apply Rinv_0_lt_compat]).
  assert (T1 : t <= 1) by nra. exists (mix t c x). rewrite dist_mix_left, dist_mix_right by assumption. nra.
Qed.

(* so a rectangle with no point within e of either is farther from c than |c - p| + e. *)
Theorem clear_of_both o w p e B : 0 <= e ->
  (forall x z, inside x B -> dist z x <= e -> dist o p < dist o z /\ dist w p < dist w z) ->
  dist (mix (/ 2) o w) p + e < ds (mix (/ 2) o w) B.
Proof.
  intros E H. apply Rnot_le_lt. intros C. destruct (near_disc (mix (/ 2) o w) (dist (mix (/ 2) o w) p) e
    (nearest (mix (/ 2) o w) B) (dist_nonneg _ _) E C) as [z [Z X]].
  destruct (H _ z (nearest_inside _ B) X). destruct (middle_disc_covered o w p z Z); lra.
Qed.

Theorem clear_at_hull o p q t e B : 0 <= t -> 0 <= e ->
  let c := (fst o + t * (snd q - snd p), snd o - t * (fst q - fst p)) in
  (forall x z, inside x B -> dist z x <= e -> dist o p < dist o z /\ 0 < orient p q z) -> dist c p + e < ds c B.
Proof.
  intros T E c H. apply Rnot_le_lt. intros C.
  destruct (near_disc c (dist c p) e (nearest c B) (dist_nonneg _ _) E C) as [z [Z X]].
  destruct (H _ z (nearest_inside _ B) X). destruct (hull_disc_covered o p q t z T Z); lra.
Qed.

(* The ends, within e of their representatives, are no farther than that from c. *)
Theorem ends_are_nearer c p e B : (forall x, inside x B -> dist p x <= e) -> dl c B <= dist c p + e.
Proof.
  intros H. pose proof (H _ (farthest_inside c B)). pose proof (dist_triangle c p (farthest c B)). unfold dl. lra.
Qed.
