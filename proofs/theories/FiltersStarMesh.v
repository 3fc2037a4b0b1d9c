(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the filters by stars take for granted of the skeleton, in a Delaunay triangulation of the representatives: the
   vertices in a disc are connected, and a vertex of the hull is higher than all by as much as than its neighbours
   [FLT-STAR]. *)
From Coq Require Import Reals Lra Lia.
From Dyadel Require Import Plane Distance Cells Inserted MeshNeighbours FiltersStarWitness.
Open Scope R_scope.

Section Mesh.
Variables (N : nat) (p : nat -> point) (T : mesh).
Variable skeleton : delaunay N p (fun k => (k < N)%nat) T.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.
Variable everybody : forall a, (a < N)%nat -> exists b c, T a b c /\ (b < N)%nat /\ (c < N)%nat.

Theorem mesh_spreads i j c : (i < N)%nat -> (j < N)%nat ->
  spreads N p i j c (fun k => next_to N T i k \/ next_to N T j k).
Proof.
  intros I J r Ri Rj Off. apply (disc_connected N p T skeleton distinct everybody i j c r I J Ri Rj).
  intros s S Si Sj. apply Off; try assumption. destruct S as [[S _] | [S _]]; exact S.
Qed.

Theorem mesh_spreads_hull v U : (v < N)%nat -> spreads_hull N p v U (next_to N T v).
Proof.
  intros V m M Low. apply (lower_than_neighbours N p T skeleton distinct everybody v U m V M).
  intros s [S [c F]]. apply Low; [exact S | split; [exact S | now exists c] |]. intros ->.
  now destruct (proj1 skeleton _ _ _ F) as (_ & X & _).
Qed.
End Mesh.
