(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Sites whose rectangles meet, and sites that are one [TIE-4]. *)
From Coq Require Import Reals Lra.
From Dyadel Require Import Plane Distance Legal.
Open Scope R_scope.

(* A place that two rectangles have in common: neither site has a legal pair but perhaps with the other. *)
Theorem meeting_not_legal N B i j k z : (j < N)%nat -> i <> j -> k <> j -> inside z (B i) -> inside z (B j) ->
  ~ legal N B i k /\ ~ legal N B k i.
Proof.
  intros J D E I M. split; intros [c W]; destruct (W j J) as [X Y]; auto;
    pose proof (ds_le c _ _ M); pose proof (le_dl c _ _ I); lra.
Qed.

(* The rectangle of both is their intersection: it holds exactly the places of two points that are one. *)
Theorem joined_exact A B : (exists z, inside z A /\ inside z B) ->
  exists C, xlo C = Rmax (xlo A) (xlo B) /\ xhi C = Rmin (xhi A) (xhi B) /\ ylo C = Rmax (ylo A) (ylo B) /\
    yhi C = Rmin (yhi A) (yhi B) /\ forall z, inside z C <-> inside z A /\ inside z B.
Proof.
  intros [w [[W1 W2] [V1 V2]]].
  assert (X : Rmax (xlo A) (xlo B) <= Rmin (xhi A) (xhi B)) by (apply Rmax_lub; apply Rmin_glb; lra).
  assert (Y : Rmax (ylo A) (ylo B) <= Rmin (yhi A) (yhi B)) by (apply Rmax_lub; apply Rmin_glb; lra).
  exists (Rect _ _ _ _ X Y). repeat (split; [reflexivity |]). intros z. unfold inside. simpl.
  pose proof (Rmax_l (xlo A) (xlo B)). pose proof (Rmax_r (xlo A) (xlo B)). pose proof (Rmin_l (xhi A) (xhi B)).
  pose proof (Rmin_r (xhi A) (xhi B)). pose proof (Rmax_l (ylo A) (ylo B)). pose proof (Rmax_r (ylo A) (ylo B)).
  pose proof (Rmin_l (yhi A) (yhi B)). pose proof (Rmin_r (yhi A) (yhi B)). split.
  - intros [Hx Hy]. lra.
  - intros [[Ax Ay] [Bx By]]. repeat split; first [apply Rmax_lub | apply Rmin_glb]; lra.
Qed.
