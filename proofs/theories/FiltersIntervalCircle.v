(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Squares of intervals, and the in-circle determinant of boxes in interval arithmetic. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersIncircle FiltersInterval
  FiltersIntervalSign.
Open Scope R_scope.

(* C src/predicate/interval_filter.h dyd_iv_sqr
  double p = a.lo * a.lo, q = a.hi * a.hi;
  if (!isfinite(p + q)) return DYD_IV_UNKNOWN;
  bool zero_inside = a.lo <= 0 && a.hi >= 0;
  double least = p < q ? p : q;
  double lo = dyd_down(least);
  return (dyd_iv){zero_inside || lo < 0 ? 0 : lo, dyd_up(p < q ? q : p)};
*)
Definition iv_sqr (a : iv) : iv :=
  let p := (lo a * lo a)%D in let q := (hi a * hi a)%D in
  if negb (is_finite 53 1024 (p + q)%D) then unknown
  else
    let zero_inside := le (lo a) (lit c_zero) && le (lit c_zero) (hi a) in
    let l := down (if lt p q then p else q) in
    {| lo := if zero_inside || lt l (lit c_zero) then lit c_zero else l; hi := up (if lt p q then q else p) |}.

Lemma le_false x y : finite x -> finite y -> le x y = false -> val y < val x.
Proof.
  intros Fx Fy H. destruct (Rlt_or_le (val y) (val x)) as [L|L]; [exact L|].
  apply (le_finite x y Fx Fy) in L. rewrite L in H. discriminate.
Qed.

Theorem iv_sqr_contains a x : contains a x -> contains (iv_sqr a) (x * x).
Proof.
  intros [[_ A1] [_ A2]]. unfold iv_sqr. cbv zeta.
  destruct (is_finite 53 1024 (lo a * lo a + hi a * hi a)%D) eqn:F; [|apply unknown_contains]. cbn [negb].
  destruct (fadd_inv _ _ F) as (Fp & Fq & _). destruct (fmul_inv _ _ Fp) as (Fl & _ & EP).
  destruct (fmul_inv _ _ Fq) as (Fh & _ & EQ). specialize (A1 Fl). specialize (A2 Fh).
  destruct zero_lit as [Fz Vz]. assert (X2 : 0 <= x * x) by apply Rle_0_sqr.
  destruct (lt_min _ _ Fp Fq) as (G1 & M1 & M2). destruct (lt_max _ _ Fp Fq) as (G2 & M3 & M4).
  split.
  - assert (Z : below (lit c_zero) (x * x)).
    { split; [intros E; rewrite E in Fz; discriminate|]. intros _. rewrite Vz. exact X2. }
    simpl lo. destruct (le (lo a) (lit c_zero) && le (lit c_zero) (hi a)) eqn:I; [exact Z|]. cbn [orb].
    destruct (lt (down _) (lit c_zero)); [exact Z|]. split; [apply down_not_inf|]. intros K.
    apply down_below; [exact K|].
    apply andb_false_iff in I. destruct I as [I|I]; apply le_false in I; try assumption; rewrite Vz in I.
    + apply Rle_trans with (1 := M1). rewrite EP. apply rnd_le, Rmult_le_compat; lra.
    + apply Rle_trans with (1 := M2). rewrite EQ. apply rnd_le.
      replace (x * x) with (- x * - x) by ring. replace (val (hi a) * val (hi a)) with (- val (hi a) * - val (hi a))
        by ring.
      apply Rmult_le_compat; lra.
  - split; [apply up_not_ninf|]. simpl. intros K. apply up_above; [exact K|].
    destruct (Rle_or_lt 0 x) as [P|P].
    + apply Rle_trans with (2 := M4). rewrite EQ. apply rnd_le, Rmult_le_compat; lra.
    + apply Rle_trans with (2 := M3). rewrite EP. apply rnd_le.
      replace (x * x) with (- x * - x) by ring. replace (val (lo a) * val (lo a)) with (- val (lo a) * - val (lo a))
        by ring.
      apply Rmult_le_compat; lra.
Qed.

Lemma zero_contains : contains {| lo := lit c_zero; hi := lit c_zero |} 0.
Proof.
  destruct zero_lit as [Fz Vz]. split; (split; simpl; [intros E; rewrite E in Fz; discriminate|intros _; rewrite Vz;
    lra]).
Qed.

(* C src/predicate/predicate_filter.c dyd_filter_incircle
  const double *const abc[3] = {a, b, c};
  dyd_iv x[3], y[3], sum = {0, 0};
  for (int k = 0; k < 3; k++) {
    x[k] = dyd_iv_sub(side_x(abc[k]), side_x(d));
    y[k] = dyd_iv_sub(side_y(abc[k]), side_y(d));
  }
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    dyd_iv norm = dyd_iv_add(dyd_iv_sqr(x[k]), dyd_iv_sqr(y[k]));
    sum = dyd_iv_add(sum, dyd_iv_mul(norm, iv_det2(x[i], y[j], x[j], y[i])));
  }
  int sign = dyd_iv_sign(sum);
  return sign > 0 ? DYD_SURE_PLUS : sign < 0 ? DYD_SURE_MINUS : DYD_UNSURE;
*)
Definition iv_term (x y xi yi xj yj : iv) : iv := iv_mul (iv_add (iv_sqr x) (iv_sqr y)) (iv_det2 xi yj xj yi).
Definition incircle_of_boxes (ax ay bx by_ cx cy dx dy : iv) : Z :=
  let x0 := iv_sub ax dx in let y0 := iv_sub ay dy in
  let x1 := iv_sub bx dx in let y1 := iv_sub by_ dy in
  let x2 := iv_sub cx dx in let y2 := iv_sub cy dy in
  let sum := iv_add {| lo := lit c_zero; hi := lit c_zero |} (iv_term x0 y0 x1 y1 x2 y2) in
  let sum := iv_add sum (iv_term x1 y1 x2 y2 x0 y0) in
  let sum := iv_add sum (iv_term x2 y2 x0 y0 x1 y1) in
  iv_sign sum.

Lemma iv_term_contains x y xi yi xj yj X Y XI YI XJ YJ : contains x X -> contains y Y -> contains xi XI -> contains yi
  YI ->
  contains xj XJ -> contains yj YJ -> contains (iv_term x y xi yi xj yj) ((X * X + Y * Y) * (XI * YJ - XJ * YI)).
Proof.
  intros. unfold iv_term, iv_det2. apply iv_mul_contains.
  - apply iv_add_contains; now apply iv_sqr_contains.
  - apply iv_sub_contains; now apply iv_mul_contains.
Qed.

(** A sign for boxes is the sign of the in-circle determinant for every choice in them. *)
Theorem incircle_of_boxes_correct ax ay bx by_ cx cy dx dy pax pay pbx pby pcx pcy pdx pdy :
  contains ax pax -> contains ay pay -> contains bx pbx -> contains by_ pby -> contains cx pcx -> contains cy pcy ->
  contains dx pdx -> contains dy pdy ->
  let det := incircle pax pay pbx pby pcx pcy pdx pdy in
  (incircle_of_boxes ax ay bx by_ cx cy dx dy = 1%Z -> 0 < det) /\
  (incircle_of_boxes ax ay bx by_ cx cy dx dy = (-1)%Z -> det < 0).
Proof.
  intros A1 A2 B1 B2 C1 C2 D1 D2 det. apply iv_sign_correct.
  replace det with (0 + ((pax - pdx) * (pax - pdx) + (pay - pdy) * (pay - pdy)) * ((pbx - pdx) * (pcy - pdy) - (pcx -
    pdx) * (pby - pdy))
    + ((pbx - pdx) * (pbx - pdx) + (pby - pdy) * (pby - pdy)) * ((pcx - pdx) * (pay - pdy) - (pax - pdx) * (pcy - pdy))
    + ((pcx - pdx) * (pcx - pdx) + (pcy - pdy) * (pcy - pdy)) * ((pax - pdx) * (pby - pdy) - (pbx - pdx) * (pay - pdy)))
    by (unfold det, incircle, det3; ring).
  repeat apply iv_add_contains; try apply zero_contains; apply iv_term_contains; now apply iv_sub_contains.
Qed.
