(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Exact signs of numbers with one [SQR-1] and with two [SQR-2] square roots, as src/dyadic/sqrt_sign.c finds them. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
Open Scope R_scope.

(** The sign of a real number. *)
Definition sgn (x : R) : Z := if Rlt_dec 0 x then 1%Z else if Rlt_dec x 0 then (-1)%Z else 0%Z.

Lemma sgn_pos x : 0 < x -> sgn x = 1%Z.
Proof. intros H; unfold sgn; destruct (Rlt_dec 0 x); [reflexivity|contradiction]. Qed.
Lemma sgn_neg x : x < 0 -> sgn x = (-1)%Z.
Proof. intros H; unfold sgn; destruct (Rlt_dec 0 x); [lra|]. destruct (Rlt_dec x 0); [reflexivity|contradiction]. Qed.
Lemma sgn_0 : sgn 0 = 0%Z.
Proof. unfold sgn; destruct (Rlt_dec 0 0); [lra|]. destruct (Rlt_dec 0 0); [lra|reflexivity]. Qed.
Lemma sgn_cases x : (0 < x /\ sgn x = 1%Z) \/ (x < 0 /\ sgn x = (-1)%Z) \/ (x = 0 /\ sgn x = 0%Z).
Proof.
  destruct (total_order_T x 0) as [[H|H]|H].
  - right; left; split; [exact H|now apply sgn_neg].
  - right; right; split; [exact H|subst; apply sgn_0].
  - left; split; [exact H|now apply sgn_pos].
Qed.
Lemma sgn_IZR a : sgn (IZR a) = Z.sgn a.
Proof.
  destruct a as [|p|p]; simpl; [apply sgn_0| |].
  - apply sgn_pos. now apply IZR_lt.
  - apply sgn_neg. now apply IZR_lt.
Qed.

(** Opposite signs: the sum has the sign of the summand of larger square. *)
Lemma sgn_opposite x y : sgn x = (- sgn y)%Z -> sgn (x + y) = (sgn x * sgn (x * x - y * y))%Z.
Proof.
  intros H. replace (x * x - y * y) with ((x - y) * (x + y)) by ring.
  assert (M : forall p q, 0 < p -> sgn (p * q) = sgn q).
  { intros p q P. destruct (sgn_cases q) as [[Q ->]|[[Q ->]|[Q ->]]].
    - apply sgn_pos. now apply Rmult_lt_0_compat.
    - apply sgn_neg. assert (0 < p * - q) by (apply Rmult_lt_0_compat; lra). lra.
    - rewrite Q, Rmult_0_r; apply sgn_0. }
  assert (N : forall q, sgn (- q) = (- sgn q)%Z).
  { intros q. destruct (sgn_cases q) as [[Q ->]|[[Q ->]|[Q ->]]].
    - apply sgn_neg; lra.
    - apply sgn_pos; lra.
    - rewrite Q, Ropp_0; apply sgn_0. }
  destruct (sgn_cases x) as [[X E]|[[X E]|[X E]]]; destruct (sgn_cases y) as [[Y E']|[[Y E']|[Y E']]];
    rewrite E, E' in H; try discriminate H; rewrite E.
  - rewrite M by lra. now destruct (sgn (x + y)).
  - replace ((x - y) * (x + y)) with ((y - x) * - (x + y)) by ring. rewrite M, N by lra. now destruct (sgn (x + y)).
  - subst; rewrite Rplus_0_r, sgn_0; reflexivity.
Qed.

Lemma sgn_same x y : sgn x = sgn y -> sgn (x + y) = sgn x.
Proof.
  destruct (sgn_cases x) as [[X ->]|[[X ->]|[X ->]]]; destruct (sgn_cases y) as [[Y ->]|[[Y ->]|[Y ->]]]; intros H;
    try discriminate H.
  - apply sgn_pos; lra.
  - apply sgn_neg; lra.
  - subst; rewrite Rplus_0_r; apply sgn_0.
Qed.

(** ** One root *)

(** Bits of |n|: 0 for 0. *)
Definition bits (n : Z) : Z := if (n =? 0)%Z then 0%Z else (Z.log2 (Z.abs n) + 1)%Z.

(* C src/dyadic/sqrt_sign.c compare_squares
  int64_t na = 2 * dyd_bits(a), nb = 2 * dyd_bits(b) + dyd_bits(c);
  if (na - 2 >= nb) return 1;
  if (nb - 3 >= na) return -1;
  mpz_t s, t;
  mpz_init(s);
  mpz_init(t);
  mpz_mul(s, a, a);
  mpz_mul(t, b, b);
  mpz_mul(t, t, c);
  int order = mpz_cmp(s, t);
  mpz_clear(t);
  mpz_clear(s);
  return (order > 0) - (order < 0);
*)
Definition compare_squares (a b c : Z) : Z :=
  let na := (2 * bits a)%Z in let nb := (2 * bits b + bits c)%Z in
  if (nb <=? na - 2)%Z then 1%Z
  else if (na <=? nb - 3)%Z then (-1)%Z
  else Z.sgn (a * a - b * b * c).

(* C src/dyadic/sqrt_sign.c dyd_sqrt_sign
  DYD_INVARIANT(mpz_sgn(c) >= 0);
  int sa = mpz_sgn(a), sb = mpz_sgn(c) ? mpz_sgn(b) : 0;
  if (!sb || sa == sb) return sa;
  if (!sa) return sb;
  return sa * compare_squares(a, b, c);
*)
Definition sqrt_sign (a b c : Z) : Z :=
  let sa := Z.sgn a in let sb := if (Z.sgn c =? 0)%Z then 0%Z else Z.sgn b in
  if (sb =? 0)%Z || (sa =? sb)%Z then sa
  else if (sa =? 0)%Z then sb
  else (sa * compare_squares a b c)%Z.

Lemma bits_spec n : n <> 0%Z -> (2 ^ (bits n - 1) <= Z.abs n < 2 ^ bits n)%Z /\ (1 <= bits n)%Z.
Proof.
  intros H. unfold bits. destruct (Z.eqb_spec n 0) as [E|_]; [contradiction|].
  pose proof (Z.log2_spec (Z.abs n) ltac:(lia)) as L. pose proof (Z.log2_nonneg (Z.abs n)).
  split; [|lia]. replace (Z.log2 (Z.abs n) + 1 - 1)%Z with (Z.log2 (Z.abs n)) by lia.
  now replace (Z.succ (Z.log2 (Z.abs n))) with (Z.log2 (Z.abs n) + 1)%Z in L by lia.
Qed.

Lemma square_bits n : n <> 0%Z -> (2 ^ (2 * bits n - 2) <= n * n < 2 ^ (2 * bits n))%Z.
Proof.
  intros H. destruct (bits_spec n H) as [[L U] P]. rewrite <- (Z.abs_square n). split.
  - replace (2 * bits n - 2)%Z with ((bits n - 1) + (bits n - 1))%Z by lia. rewrite Z.pow_add_r by lia.
    assert (0 < 2 ^ (bits n - 1))%Z by (apply Z.pow_pos_nonneg; lia). apply Z.mul_le_mono_nonneg; lia.
  - replace (2 * bits n)%Z with (bits n + bits n)%Z by lia. rewrite Z.pow_add_r by lia.
    apply Z.mul_lt_mono_nonneg; lia.
Qed.

Lemma compare_squares_correct a b c : a <> 0%Z -> b <> 0%Z -> (0 < c)%Z ->
  compare_squares a b c = Z.sgn (a * a - b * b * c).
Proof.
  intros A B C. destruct (square_bits a A) as [La Ua]. destruct (square_bits b B) as [Lb Ub].
  destruct (bits_spec a A) as [_ Pa]. destruct (bits_spec b B) as [_ Pb].
  destruct (bits_spec c ltac:(lia)) as [[Lc Uc] Pc]. rewrite Z.abs_eq in Lc, Uc by lia.
  unfold compare_squares. cbv zeta. destruct (Z.leb_spec (2 * bits b + bits c) (2 * bits a - 2)) as [H|_].
  - symmetry; apply Z.sgn_pos. assert (b * b * c < 2 ^ (2 * bits b) * 2 ^ bits c)%Z.
    { apply Z.mul_lt_mono_nonneg; try apply Z.square_nonneg; lia. }
    rewrite <- Z.pow_add_r in H0 by lia.
    pose proof (Z.pow_le_mono_r 2 (2 * bits b + bits c) (2 * bits a - 2) ltac:(lia) H). lia.
  - destruct (Z.leb_spec (2 * bits a) (2 * bits b + bits c - 3)) as [H|_]; [|reflexivity].
    symmetry; apply Z.sgn_neg. assert (2 ^ (2 * bits b - 2) * 2 ^ (bits c - 1) <= b * b * c)%Z.
    { apply Z.mul_le_mono_nonneg; try assumption; apply Z.pow_nonneg; lia. }
    rewrite <- Z.pow_add_r in H0 by lia.
    pose proof (Z.pow_le_mono_r 2 (2 * bits a) (2 * bits b - 2 + (bits c - 1)) ltac:(lia) ltac:(lia)). lia.
Qed.

Lemma root_sign b c : (0 <= c)%Z -> (if (Z.sgn c =? 0)%Z then 0%Z else Z.sgn b) = sgn (IZR b * sqrt (IZR c)).
Proof.
  intros C. destruct (Z.eqb_spec (Z.sgn c) 0) as [E|E].
  - assert (c = 0)%Z by lia; subst. rewrite sqrt_0, Rmult_0_r. symmetry; apply sgn_0.
  - assert (P : 0 < sqrt (IZR c)) by (apply sqrt_lt_R0, IZR_lt; lia).
    rewrite <- sgn_IZR. destruct (sgn_cases (IZR b)) as [[X ->]|[[X ->]|[X ->]]]; symmetry.
    + apply sgn_pos. now apply Rmult_lt_0_compat.
    + apply sgn_neg. assert (0 < - IZR b * sqrt (IZR c)) by (apply Rmult_lt_0_compat; lra). lra.
    + rewrite X, Rmult_0_l; apply sgn_0.
Qed.

(** [SQR-1] *)
Theorem sqrt_sign_correct a b c : (0 <= c)%Z -> sqrt_sign a b c = sgn (IZR a + IZR b * sqrt (IZR c)).
Proof.
  intros C. unfold sqrt_sign. cbv zeta. rewrite (root_sign b c C), <- (sgn_IZR a).
  set (y := IZR b * sqrt (IZR c)).
  destruct (Z.eqb_spec (sgn y) 0) as [E|E]; [|destruct (Z.eqb_spec (sgn (IZR a)) (sgn y)) as [S|S]]; cbn [orb].
  - destruct (sgn_cases y) as [[_ Y]|[[_ Y]|[Y _]]]; [lia|lia|]. now rewrite Y, Rplus_0_r.
  - symmetry; now apply sgn_same.
  - destruct (Z.eqb_spec (sgn (IZR a)) 0) as [A|A].
    + destruct (sgn_cases (IZR a)) as [[_ Y]|[[_ Y]|[Y _]]]; [lia|lia|]. now rewrite Y, Rplus_0_l.
    + assert (O : sgn (IZR a) = (- sgn y)%Z).
      { destruct (sgn_cases (IZR a)) as [[_ X]|[[_ X]|[_ X]]]; destruct (sgn_cases y) as [[_ Y]|[[_ Y]|[_ Y]]]; lia. }
      rewrite sgn_opposite by exact O. f_equal.
      unfold y in E. rewrite <- root_sign in E by exact C. rewrite sgn_IZR in A.
      destruct (Z.eqb_spec (Z.sgn c) 0) as [Z0|Z0]; [contradiction|].
      rewrite compare_squares_correct by lia.
      rewrite <- sgn_IZR, minus_IZR, !mult_IZR. f_equal. unfold y.
      replace (IZR b * sqrt (IZR c) * (IZR b * sqrt (IZR c))) with (IZR b * IZR b * (sqrt (IZR c) * sqrt (IZR c))) by
        ring.
      rewrite sqrt_sqrt; [ring|now apply IZR_le].
Qed.

(** ** Two roots *)

(* C src/dyadic/sqrt_sign.c dyd_sqrt2_sign
  DYD_INVARIANT(mpz_sgn(e) >= 0);
  int sx = dyd_sqrt_sign(a, b, c), sy = mpz_sgn(e) ? mpz_sgn(d) : 0;
  if (!sy || sx == sy) return sx;
  if (!sx) return sy;
  mpz_t p, q, t;
  mpz_init(p);
  mpz_init(q);
  mpz_init(t);
  mpz_mul(p, a, a);
  mpz_mul(t, b, b);
  mpz_addmul(p, t, c);
  mpz_mul(t, d, d);
  mpz_submul(p, t, e);
  mpz_mul(q, a, b);
  mpz_mul_2exp(q, q, 1);
  int sign = sx * dyd_sqrt_sign(p, q, c);
  mpz_clear(t);
  mpz_clear(q);
  mpz_clear(p);
  return sign;
*)
Definition sqrt2_sign (a b c d e : Z) : Z :=
  let sx := sqrt_sign a b c in let sy := if (Z.sgn e =? 0)%Z then 0%Z else Z.sgn d in
  if (sy =? 0)%Z || (sx =? sy)%Z then sx
  else if (sx =? 0)%Z then sy
  else
    let p := (a * a + b * b * c - d * d * e)%Z in
    let q := (a * b * 2)%Z in
    (sx * sqrt_sign p q c)%Z.

(** [SQR-2] *)
Theorem sqrt2_sign_correct a b c d e : (0 <= c)%Z -> (0 <= e)%Z ->
  sqrt2_sign a b c d e = sgn (IZR a + IZR b * sqrt (IZR c) + IZR d * sqrt (IZR e)).
Proof.
  intros C E. unfold sqrt2_sign. cbv zeta. rewrite (root_sign d e E), !sqrt_sign_correct by exact C.
  set (x := IZR a + IZR b * sqrt (IZR c)). set (y := IZR d * sqrt (IZR e)).
  destruct (Z.eqb_spec (sgn y) 0) as [Y|Y]; [|destruct (Z.eqb_spec (sgn x) (sgn y)) as [S|S]]; cbn [orb].
  - destruct (sgn_cases y) as [[_ Z]|[[_ Z]|[Z _]]]; [lia|lia|]. now rewrite Z, Rplus_0_r.
  - symmetry; now apply sgn_same.
  - destruct (Z.eqb_spec (sgn x) 0) as [A|A].
    + destruct (sgn_cases x) as [[_ Z]|[[_ Z]|[Z _]]]; [lia|lia|]. now rewrite Z, Rplus_0_l.
    + assert (O : sgn x = (- sgn y)%Z).
      { destruct (sgn_cases x) as [[_ X]|[[_ X]|[_ X]]]; destruct (sgn_cases y) as [[_ Z]|[[_ Z]|[_ Z]]]; lia. }
      rewrite (sgn_opposite x y) by exact O. do 2 f_equal.
      rewrite minus_IZR, plus_IZR, !mult_IZR. unfold x, y.
      pose proof (sqrt_sqrt (IZR c) (IZR_le _ _ C)) as QC. pose proof (sqrt_sqrt (IZR e) (IZR_le _ _ E)) as QE.
      rewrite <- QC at 1. rewrite <- QE at 1. ring.
Qed.
