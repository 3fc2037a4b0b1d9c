(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Identities [IDN-1]: expressions that reduce to the same polynomial modulo relations that hold at the leaves have the
   same value; and the relations that are used hold. Expressions are those of Coq's own ring normalisation, in leaves
   PEX 1, PEX 2, ... with integers as constants; a relation rewrites a monomial into a polynomial. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Ring Ring_polynom InitialRing RealField.
Open Scope R_scope.

Definition expression : Type := PExpr Z.
(* leaf: the values of the leaves. *)
Definition value (leaf : list R) (e : expression) : R := PEeval 0 1 Rplus Rmult Rminus Ropp IZR N.to_nat pow leaf e.
Definition holds (leaf : list R) (relations : list (expression * expression)) : Prop :=
  interp_PElist 0 1 Rplus Rmult Rminus Ropp eq IZR N.to_nat pow leaf relations.
(* The normal form, each relation used up to n times in a row. *)
Definition normal (n : nat) (relations : list (expression * expression)) (e : expression) : Pol Z :=
  norm_subst 0%Z 1%Z Z.add Z.mul Z.sub Z.opp Zeq_bool Z.quotrem n
    (mk_monpol_list 0%Z 1%Z Z.add Z.mul Z.sub Z.opp Zeq_bool Z.quotrem relations) e.
Definition same (P Q : Pol Z) : bool := Peq Zeq_bool P Q.

Lemma integers_in_reals : ring_morph 0 1 Rplus Rmult Rminus Ropp eq 0%Z 1%Z Z.add Z.mul Z.sub Z.opp Zeq_bool IZR.
Proof.
  constructor; try reflexivity.
  - exact plus_IZR.
  - exact minus_IZR.
  - exact mult_IZR.
  - exact opp_IZR.
  - intros x y E. f_equal. now apply Zeq_bool_eq.
Qed.

(* What the algebra may conclude: the leaves are any numbers at which the relations hold. *)
Theorem identity n relations leaf P Q : holds leaf relations ->
  same (normal n relations P) (normal n relations Q) = true -> value leaf P = value leaf Q.
Proof.
  intros H E. unfold value.
  apply (ring_correct (Eqsth R) (Eq_ext Rplus Rmult Ropp) (Rth_ARth (Eqsth R) (Eq_ext Rplus Rmult Ropp) RTheory)
    integers_in_reals R_power_theory (Ztriv_div_th (Eqsth R) IZR) n leaf relations P Q H E).
Qed.

Corollary identity_zero n relations leaf P : holds leaf relations ->
  same (normal n relations P) (normal n relations (PEc 0%Z)) = true -> value leaf P = 0.
Proof. intros H E. now rewrite (identity n relations leaf P (PEc 0%Z) H E). Qed.

(* A fraction whose numerator is 0, and whose denominator is not, is 0; a product of divisors is no zero divisor. *)
Theorem fraction_zero P Q : Q <> 0 -> P = 0 -> P / Q = 0.
Proof. intros _ ->. unfold Rdiv. apply Rmult_0_l. Qed.

Theorem divisors_nonzero P Q : P <> 0 -> Q <> 0 -> P * Q <> 0.
Proof. apply Rmult_integral_contrapositive_currified. Qed.

(* 2 cos(k t) as a polynomial in 2 cos(t): by halves, as cosine.c finds it. *)
Theorem cosine_even t k : 2 * cos (INR (2 * k) * t) = 2 * cos (INR k * t) * (2 * cos (INR k * t)) - 2.
Proof.
  replace (INR (2 * k) * t) with (2 * (INR k * t)) by (rewrite mult_INR; simpl; ring).
  rewrite cos_2a_cos. ring.
Qed.

Theorem cosine_odd t k :
  2 * cos (INR (2 * k + 1) * t) = 2 * cos (INR k * t) * (2 * cos (INR (k + 1) * t)) - 2 * cos t.
Proof.
  set (a := INR k * t). set (b := INR (k + 1) * t).
  replace (INR (2 * k + 1) * t) with (a + b) by (unfold a, b; rewrite !plus_INR, mult_INR; simpl; ring).
  replace t with (b - a) by (unfold a, b; rewrite plus_INR; simpl; ring).
  rewrite cos_plus, cos_minus. ring.
Qed.

Theorem cosine_sine t : sin t * sin t + cos t * cos t = 1.
Proof. exact (sin2_cos2 t). Qed.

(* Sines of parts of pi are cosines. *)
Theorem sine_is_cosine t : sin t = cos (PI / 2 - t).
Proof. symmetry. apply cos_shift. Qed.

Theorem square_root b : 0 <= b -> sqrt b ^ 2 = b.
Proof. intros H. rewrite <- Rsqr_pow2. now apply Rsqr_sqrt. Qed.

(* a^(n-1) f(x / a) at x = a r, for f = a z^n + rest(z), is monic and 0 where f(r) = 0. *)
Theorem scaled_root a r n rest : a <> 0 -> a * r ^ S n + rest r = 0 -> (a * r) ^ S n + a ^ n * rest ((a * r) / a) = 0.
Proof.
  intros A H. replace (a * r / a) with r by (field; exact A). rewrite Rpow_mult_distr. simpl (a ^ S n).
  transitivity (a ^ n * (a * r ^ S n + rest r)); [ring | rewrite H; ring].
Qed.

(* An example, by computation: sqrt 3 sqrt 2 against sqrt 6 = sqrt 2 sqrt 3, and (1 + sqrt 2)^2 = 3 + 2 sqrt 2. *)
Example silver leaf : holds leaf ((PEpow (PEX Z 1) 2, PEc 2%Z) :: nil) ->
  value leaf (PEpow (PEadd (PEc 1%Z) (PEX Z 1)) 2) = value leaf (PEadd (PEc 3%Z) (PEmul (PEc 2%Z) (PEX Z 1))).
Proof. intros H. now apply (identity 5 _ leaf _ _ H). Qed.
