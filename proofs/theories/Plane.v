(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Points of the plane and Euclidean distance. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Definition point : Type := (R * R)%type.

(* Square of the distance of two points, and the distance. *)
Definition dist2 (a b : point) : R := Rsqr (fst a - fst b) + Rsqr (snd a - snd b).
Definition dist (a b : point) : R := sqrt (dist2 a b).

Lemma dist2_nonneg a b : 0 <= dist2 a b.
Proof. unfold dist2. pose proof (Rle_0_sqr (fst a - fst b)). pose proof (Rle_0_sqr (snd a - snd b)). lra. Qed.

Lemma dist_nonneg a b : 0 <= dist a b.
Proof. apply sqrt_pos. Qed.
