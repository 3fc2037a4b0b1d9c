(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-DST] The axis distances of the distance filters are those of ds and dl in Distance.v. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Distance FiltersDistance.
Open Scope R_scope.

Lemma Ds_square x0 x1 c : x0 <= x1 -> Ds x0 x1 c * Ds x0 x1 c = (c - clamp x0 x1 c) * (c - clamp x0 x1 c).
Proof.
  intros H. unfold Ds, clamp. destruct (Rle_or_lt c x0) as [A|A]; [|destruct (Rle_or_lt x1 c) as [B|B]].
  - rewrite (Rmin_right x1 c), (Rmax_left x0 c), (Rmax_left (x0 - c) (c - x1)), (Rmax_left (x0 - c) 0) by lra. ring.
  - rewrite (Rmin_left x1 c), (Rmax_right x0 x1), (Rmax_right (x0 - c) (c - x1)), (Rmax_left (c - x1) 0) by lra. ring.
  - rewrite (Rmin_right x1 c), (Rmax_right x0 c) by lra. rewrite (Rmax_right (Rmax (x0 - c) (c - x1)) 0) by (apply
    Rmax_lub; lra). ring.
Qed.

Lemma Dl_square x0 x1 c : Dl x0 x1 c * Dl x0 x1 c = (c - far_end x0 x1 c) * (c - far_end x0 x1 c).
Proof.
  unfold Dl, far_end, Rmax. destruct (Rle_dec (c - x0) (x1 - c)); destruct (Rle_dec (x1 - c) (c - x0)); try ring.
  - replace (x1 - c) with (c - x0) by lra. ring.
  - lra.
Qed.

Theorem ds_square c B :
  ds c B * ds c B = Ds (xlo B) (xhi B) (fst c) * Ds (xlo B) (xhi B) (fst c) + Ds (ylo B) (yhi B) (snd c) * Ds (ylo B)
    (yhi B) (snd c).
Proof. unfold ds. rewrite dist_sq, (Ds_square _ _ _ (x_ordered B)), (Ds_square _ _ _ (y_ordered B)). reflexivity. Qed.

Theorem dl_square c B :
  dl c B * dl c B = Dl (xlo B) (xhi B) (fst c) * Dl (xlo B) (xhi B) (fst c) + Dl (ylo B) (yhi B) (snd c) * Dl (ylo B)
    (yhi B) (snd c).
Proof. unfold dl. rewrite dist_sq, !Dl_square. reflexivity. Qed.
