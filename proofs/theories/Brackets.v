(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What brackets of a root rest on [ROOT-1]. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

(* Opposite signs at the ends: a root between them. *)
Theorem bracket_root f a b : continuity f -> a < b -> f a * f b < 0 -> exists z, a < z < b /\ f z = 0.
Proof.
  intros C L S. destruct (IVT_cor f a b C (Rlt_le _ _ L) (Rlt_le _ _ S)) as [z [[A B] Z]]. exists z. split; [| exact Z].
  split; [destruct A as [A | ->] | destruct B as [B | ->]]; try assumption; rewrite Z in S; lra.
Qed.

(* A place between the ends: the root itself, or exactly one of both parts has opposite signs at its ends. *)
Theorem bracket_part (f : R -> R) a m b : f a * f b < 0 -> f m = 0 \/
  (f a * f m < 0 /\ 0 < f m * f b) \/ (0 < f a * f m /\ f m * f b < 0).
Proof.
  intros S. destruct (Rtotal_order (f m) 0) as [M | [M | M]]; [| now left |]; right;
    destruct (Rtotal_order (f a) 0) as [A | [A | A]]; try (rewrite A in S; lra).
  - assert (0 < f b) by nra. right. split; nra.
  - assert (f b < 0) by nra. left. split; nra.
  - assert (0 < f b) by nra. left. split; nra.
  - assert (f b < 0) by nra. right. split; nra.
Qed.

(* Where the derivative has no zero there is one root at most. *)
Theorem bracket_one_root f f' a b y z : (forall c, a <= c <= b -> derivable_pt_lim f c (f' c)) ->
  (forall c, a <= c <= b -> f' c <> 0) -> a <= y <= b -> a <= z <= b -> f y = 0 -> f z = 0 -> y = z.
Proof.
  intros D N. assert (K : forall u v, a <= u <= b -> a <= v <= b -> u < v -> f u = 0 -> f v = 0 -> False).
  { intros u v U V L Fu Fv. destruct (MVT_cor2 f f' u v L) as [c [E [C1 C2]]]; [intros c C; apply D; lra |].
    rewrite Fu, Fv in E. assert (f' c <> 0) by (apply N; lra). assert (f' c * (v - u) <> 0); [| lra].
    apply Rmult_integral_contrapositive_currified; lra. }
  intros Y Z Fy Fz. destruct (Rtotal_order y z) as [L | [E | L]]; [| exact E |]; exfalso.
  - now apply (K y z).
  - now apply (K z y).
Qed.
