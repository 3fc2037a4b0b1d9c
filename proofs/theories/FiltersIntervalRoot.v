(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Interval arithmetic of src/predicate/interval_filter.h: negatives, multiples, quotients and roots. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersInterval FiltersIntervalSign.
Open Scope R_scope.

(** ** Division of doubles *)

(** What dividing by g multiplies with: an infinite g makes the quotient 0. *)
Definition recip (g : double) : R := if is_finite 53 1024 g then / val g else 0.

Section Div.
Local Transparent fdiv.
Lemma fdiv_inv x y : (finite y -> val y <> 0) -> finite (x / y)%D ->
  finite x /\ is_nan 53 1024 y = false /\ val (x / y)%D = rnd (val x * recip y).
Proof.
  intros N H. unfold recip. destruct (is_finite 53 1024 y) eqn:Fy.
  - specialize (N eq_refl).
    generalize (Bdiv_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y N).
    change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
    fold (b64_div mode_NE x y); change (b64_div mode_NE x y) with (x / y)%D.
    case Rlt_bool_spec; intros K.
    + intros (A & B & _). rewrite B in H. split; [exact H|]. split; [|exact A]. destruct y; try discriminate; reflexivity.
    + intros A. apply overflow_infinite in A. rewrite A in H. discriminate.
  - destruct y as [s|s|s p Hp|s m e He]; try discriminate; destruct x as [t|t|t q Hq|t n d Hd]; try discriminate;
      (split; [reflexivity|split; [reflexivity|]]; rewrite Rmult_0_r, round_0 by typeclasses eauto; reflexivity).
Qed.
Lemma div_nan x y : is_nan 53 1024 y = true -> is_finite 53 1024 (x / y)%D = true -> False.
Proof. destruct y; try discriminate; destruct x; discriminate. Qed.
End Div.

(* C src/predicate/interval_filter.h dyd_iv_div
  if (!(b.lo > 0 || b.hi < 0)) return DYD_IV_UNKNOWN;
  return dyd_iv_span4(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi);
*)
Definition iv_div (a b : iv) : iv :=
  if negb (gt (lo b) (lit c_zero) || lt (hi b) (lit c_zero)) then unknown
  else span4 (lo a / lo b) (lo a / hi b) (hi a / lo b) (hi a / hi b).

(** An end that passes for positive is finite or infinite, not NaN. *)
Lemma gt_zero f : gt f (lit c_zero) = true -> (finite f /\ 0 < val f) \/ f = inf.
Proof.
  destruct zero_lit as [Fz Vz]. intros G. destruct (cases f) as [F|[F|[F|F]]].
  - left. split; [exact F|]. apply gt_finite in G; [lra|exact F|exact Fz].
  - exfalso. destruct f; try discriminate; destruct (lit c_zero); discriminate.
  - now right.
  - exfalso. rewrite F, (gt_ninf _ Fz) in G. discriminate.
Qed.
Lemma lt_zero f : lt f (lit c_zero) = true -> (finite f /\ val f < 0) \/ f = ninf.
Proof.
  destruct zero_lit as [Fz Vz]. intros G. destruct (cases f) as [F|[F|[F|F]]].
  - left. split; [exact F|]. apply lt_finite in G; [lra|exact F|exact Fz].
  - exfalso. destruct f; try discriminate; destruct (lit c_zero); discriminate.
  - exfalso. rewrite F in G. destruct (lit c_zero); discriminate.
  - now right.
Qed.

(** The reciprocals of ends of one sign enclose the reciprocal. *)
Lemma recips b y : contains b y -> gt (lo b) (lit c_zero) = true \/ lt (hi b) (lit c_zero) = true ->
  is_nan 53 1024 (lo b) = false -> is_nan 53 1024 (hi b) = false ->
  (finite (lo b) -> val (lo b) <> 0) /\ (finite (hi b) -> val (hi b) <> 0) /\ recip (hi b) <= / y <= recip (lo b).
Proof.
  intros [[N1 B1] [N2 B2]] S L H. unfold recip. destruct S as [S|S].
  - apply gt_zero in S. destruct S as [[F P]|S]; [|contradiction]. specialize (B1 F). rewrite F.
    assert (Y : 0 < / y) by (apply Rinv_0_lt_compat; lra).
    split; [intros _; lra|]. split; [intros G; specialize (B2 G); lra|]. split; [|now apply Rinv_le_contravar].
    destruct (is_finite 53 1024 (hi b)) eqn:G; [|lra]. specialize (B2 eq_refl). apply Rinv_le_contravar; lra.
  - apply lt_zero in S. destruct S as [[F P]|S]; [|contradiction]. specialize (B2 F). rewrite F.
    assert (Y : 0 < / - y) by (apply Rinv_0_lt_compat; lra). rewrite Rinv_opp in Y.
    assert (C : forall p q, p <= q -> q < 0 -> / q <= / p).
    { intros p q PQ Q. apply Ropp_le_cancel. rewrite <- !Rinv_opp. apply Rinv_le_contravar; lra. }
    split; [intros G; specialize (B1 G); lra|]. split; [intros _; lra|]. split; [now apply C|].
    destruct (is_finite 53 1024 (lo b)) eqn:G; [|lra]. specialize (B1 eq_refl). apply C; lra.
Qed.

(** Quotients of the numbers of a and of b; no statement is made when b may hold 0. *)
Theorem iv_div_contains a b x y : contains a x -> contains b y -> contains (iv_div a b) (x / y).
Proof.
  intros [[_ A1] [_ A2]] B. unfold iv_div.
  destruct (gt (lo b) (lit c_zero) || lt (hi b) (lit c_zero)) eqn:E; [|apply unknown_contains]. cbn [negb].
  apply orb_true_iff in E. apply span4_contains. intros P Q R S.
  assert (NL : is_nan 53 1024 (lo b) = false).
  { destruct (is_nan 53 1024 (lo b)) eqn:N; [|reflexivity]. exfalso. revert P. apply div_nan, N. }
  assert (NH : is_nan 53 1024 (hi b) = false).
  { destruct (is_nan 53 1024 (hi b)) eqn:N; [|reflexivity]. exfalso. revert Q. apply div_nan, N. }
  destruct (recips b y B E NL NH) as (Z1 & Z2 & Y1 & Y2).
  destruct (fdiv_inv _ _ Z1 P) as (F1 & _ & EP). destruct (fdiv_inv _ _ Z2 Q) as (_ & _ & EQ).
  destruct (fdiv_inv _ _ Z1 R) as (F2 & _ & ER). destruct (fdiv_inv _ _ Z2 S) as (_ & _ & ES).
  rewrite EP, EQ, ER, ES. specialize (A1 F1). specialize (A2 F2). unfold Rdiv. split.
  - destruct (corner_low _ _ _ _ _ _ (conj A1 A2) (conj Y1 Y2)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
  - destruct (corner_high _ _ _ _ _ _ (conj A1 A2) (conj Y1 Y2)) as [H|[H|[H|H]]]; apply rnd_le in H; tauto.
Qed.

(* C src/predicate/interval_filter.h dyd_iv_sqrt
  if (!(a.hi >= 0) || isnan(a.lo)) return DYD_IV_UNKNOWN;
  double lo = a.lo > 0 ? dyd_down(sqrt(a.lo)) : 0;
  return (dyd_iv){lo < 0 ? 0 : lo, dyd_up(sqrt(a.hi))};
*)
Definition iv_sqrt (a : iv) : iv :=
  if negb (le (lit c_zero) (hi a)) || is_nan 53 1024 (lo a) then unknown
  else
    let l := if gt (lo a) (lit c_zero) then down (fsqrt (lo a)) else lit c_zero in
    {| lo := if lt l (lit c_zero) then lit c_zero else l; hi := up (fsqrt (hi a)) |}.

(** Roots of the numbers of a that have one. *)
Theorem iv_sqrt_contains a x : contains a x -> 0 <= x -> contains (iv_sqrt a) (sqrt x).
Proof.
  intros [[_ A1] [_ A2]] X. unfold iv_sqrt. destruct (_ || _); [apply unknown_contains|]. cbv zeta.
  destruct zero_lit as [Fz Vz]. split.
  - assert (Z : below (lit c_zero) (sqrt x)).
    { split; [intros E; rewrite E in Fz; discriminate|]. intros _. rewrite Vz. apply sqrt_pos. }
    cbn [lo]. destruct (lt _ _); [exact Z|]. destruct (gt _ _); [|exact Z].
    split; [apply down_not_inf|]. intros K. apply down_below; [exact K|].
    destruct (fsqrt_inv _ (down_finite _ K)) as (F & _ & ->). apply rnd_le, sqrt_le_1_alt, A1, F.
  - split; [apply up_not_ninf|]. cbn [hi]. intros K. apply up_above; [exact K|].
    destruct (fsqrt_inv _ (up_finite _ K)) as (F & _ & ->). apply rnd_le, sqrt_le_1_alt, A2, F.
Qed.

(* C src/predicate/interval_filter.h dyd_iv_point
  return (dyd_iv){x, x};
*)
Definition iv_point (x : double) : iv := {| lo := x; hi := x |}.
Lemma iv_point_contains x : finite x -> contains (iv_point x) (val x).
Proof. intros F. split; (split; [intros E; simpl in E; subst; discriminate|intros _; simpl; lra]). Qed.

(* C src/predicate/interval_filter.h dyd_iv_neg
  return (dyd_iv){-a.hi, -a.lo};
*)
Definition iv_neg (a : iv) : iv := {| lo := - hi a; hi := - lo a |}.
Section Neg.
Local Transparent fopp.
Lemma iv_neg_contains a x : contains a x -> contains (iv_neg a) (- x).
Proof.
  intros [[N1 A1] [N2 A2]]. split; (split; cbn [lo hi iv_neg];
    [intros E|intros F; rewrite fopp_finite in F; rewrite fopp_val]).
  - apply N2. destruct (hi a) as [s|[|]|s p Hp|s m e He]; try discriminate; reflexivity.
  - specialize (A2 F). lra.
  - apply N1. destruct (lo a) as [s|[|]|s p Hp|s m e He]; try discriminate; reflexivity.
  - specialize (A1 F). lra.
Qed.
End Neg.

(* C src/predicate/interval_filter.h dyd_iv_scale
  return (dyd_iv){dyd_down(a.lo * f), dyd_up(a.hi * f)};
*)
Definition iv_scale (a : iv) (f : double) : iv := {| lo := down (lo a * f); hi := up (hi a * f) |}.
(** Whether or not the product is exact. *)
Lemma iv_scale_contains a f x : 0 <= val f -> contains a x -> contains (iv_scale a f) (x * val f).
Proof.
  intros P [[_ A1] [_ A2]]. split; (split; [apply down_not_inf || apply up_not_ninf|]); cbn [lo hi iv_scale]; intros F.
  - destruct (fmul_inv _ _ (down_finite _ F)) as (F1 & F2 & E). apply down_below; [exact F|]. rewrite E. apply rnd_le.
    apply Rmult_le_compat_r; [exact P|now apply A1].
  - destruct (fmul_inv _ _ (up_finite _ F)) as (F1 & F2 & E). apply up_above; [exact F|]. rewrite E. apply rnd_le.
    apply Rmult_le_compat_r; [exact P|now apply A2].
Qed.
