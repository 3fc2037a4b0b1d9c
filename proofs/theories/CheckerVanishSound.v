(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A polynomial that vanishes is 0, whatever cofactors are given, and of any origin. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import CheckerEnclosure CheckerEnclosureSound CheckerAlgebra CheckerAlgebraSound CheckerVanish.
Import ListNotations.
Open Scope R_scope.

Section Sound.

(* The values of leaves, at which the relations hold, in their intervals. *)
Variable l : nat -> R.
Variable most u : Z.
Variable U : (0 < u)%Z.
Variable leaves : list (option relation).
Variable R0 : relations_hold l 0 leaves.
Variable held : list interval.
Variable H : leaves_held l u 0 held.

Lemma iterated_value p w m : value_of l (N.iter m (product_of leaves p) w) = value_of l p ^ N.to_nat m * value_of l w.
Proof.
  induction m as [| m IH] using N.peano_ind; [simpl; ring |].
  rewrite N.iter_succ, N2Nat.inj_succ, (product_of_value l leaves R0), IH. simpl. ring.
Qed.

(* A power of p times w is 0, and w is not. *)
Theorem vanishing_zero p h : vanishes most u leaves held p h = true -> value_of l p = 0.
Proof.
  destruct h as [m w]. unfold vanishes. cbn [fst snd]. intros E. apply andb_prop in E as [S E].
  apply negb_true_iff, Z.eqb_neq in S.
  pose proof (sign_not_zero u U _ _ (enclose_poly_holds l most u U w held H) S) as W.
  pose proof (iterated_value p w m) as V. destruct (N.iter m (product_of leaves p) w) as [| t q]; [| discriminate].
  simpl in V. symmetry in V. apply Rmult_integral in V as [V | V]; [| contradiction].
  destruct (Req_dec (value_of l p) 0) as [Z | Z]; [exact Z |]. now apply (pow_nonzero _ (N.to_nat m)) in Z.
Qed.

(* So is a quotient whose numerator it is. *)
Theorem vanishing_quotient p q x h : is_quotient l (Some (p, q)) x -> vanishes most u leaves held p h = true -> x = 0.
Proof. intros [N ->] V. rewrite (vanishing_zero p h V). field. exact N. Qed.

End Sound.

(* ---- examples: x and y are both the root of 2, z is the third root of a number that is 0; units of 2^-30 ---- *)

Section Examples.

Open Scope Z_scope.

Let root : interval := Some (1518500249, 1518500250).
Let square : option relation := Some (Relation 2 (constant 2)).
Let difference : poly := plus (variable 0) (minus (variable 1)).
Let sum : poly := plus (variable 0) (variable 1).
Let taken := vanishes (2 ^ 99) (2 ^ 30) [square; square; Some (Relation 3 difference)] [root; root; Some (-1, 1)].

Example taken_hint : taken difference (1%N, sum) = true.
Proof. reflexivity. Qed.
Example taken_power : taken (variable 2) (3%N, sum) = true /\ taken (variable 2) (1%N, sum) = false.
Proof. split; reflexivity. Qed.
(* A part of the hint, another one, none. *)
Example wrong_hints : map (taken difference) [(1%N, variable 0); (1%N, plus sum (constant 1)); (1%N, constant 1); (0%N, sum);
  (1%N, []); (0%N, [])] = repeat false 6.
Proof. reflexivity. Qed.
(* x + y is not 0: what makes the product 0 is. *)
Example no_zero : taken sum (1%N, difference) = false.
Proof. reflexivity. Qed.

End Examples.
