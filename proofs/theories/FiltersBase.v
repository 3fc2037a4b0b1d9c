(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** The doubles of the C code: binary64 of Flocq, every operation rounded to nearest even, subnormals, infinities and
    NaN included; and the calculus of rounding errors used by all filters. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Relative Plus_error BinarySingleNaN Binary Bits.
Open Scope R_scope.

Notation double := binary64.
Notation fexp := (FLT_exp (-1074) 53).
Notation format := (generic_format radix2 fexp).
(** Round to nearest, ties to even, without an upper bound of the exponent. *)
Notation rnd := (round radix2 fexp ZnearestE).
Notation val := (B2R 53 1024).
Notation finite x := (is_finite 53 1024 x = true).

#[global] Instance prec_53 : Prec_gt_0 53.
Proof. reflexivity. Qed.

(** ** The operations and comparisons of C *)

Declare Scope double_scope.
Delimit Scope double_scope with D.
Bind Scope double_scope with binary64.
Definition fadd : double -> double -> double := b64_plus mode_NE.
Definition fsub : double -> double -> double := b64_minus mode_NE.
Definition fmul : double -> double -> double := b64_mult mode_NE.
Definition fdiv : double -> double -> double := b64_div mode_NE.
Definition fsqrt : double -> double := b64_sqrt mode_NE.
Definition fopp : double -> double := b64_opp.
Definition fabs : double -> double := b64_abs.
Infix "+" := fadd : double_scope.
Infix "-" := fsub : double_scope.
Infix "*" := fmul : double_scope.
Infix "/" := fdiv : double_scope.
Notation "- x" := (fopp x) : double_scope.

(** x > y, x < y and x <= y in C: false when one is NaN. *)
Definition gt (x y : double) : bool := match b64_compare x y with Some Gt => true | _ => false end.
Definition lt (x y : double) : bool := match b64_compare x y with Some Lt => true | _ => false end.
Definition le (x y : double) : bool := match b64_compare x y with Some Lt | Some Eq => true | _ => false end.

(** ** Constants: (m, e) is the double m * 2^e. *)

Definition const := (Z * Z)%type.
Definition lit (c : const) : double :=
  binary_normalize 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) mode_NE (fst c) (snd c) false.
Definition is_double (c : const) : bool :=
  (Z.abs (fst c) <? 2 ^ 53)%Z && (-1074 <=? snd c)%Z && (snd c <=? 971)%Z.
Definition cval (c : const) : R := IZR (fst c) * bpow radix2 (snd c).

Lemma lit_correct c : is_double c = true -> finite (lit c) /\ val (lit c) = cval c.
Proof.
  destruct c as [m e]; unfold is_double, lit, cval; cbn [fst snd]; intros H.
  apply andb_prop in H; destruct H as [H H3]; apply andb_prop in H; destruct H as [H1 H2].
  apply Z.ltb_lt in H1; apply Z.leb_le in H2; apply Z.leb_le in H3.
  assert (G : format (F2R (Float radix2 m e))).
  { apply generic_format_FLT; exists (Float radix2 m e); [reflexivity|exact H1|exact H2]. }
  generalize (binary_normalize_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) mode_NE m e false).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  rewrite round_generic; [|apply valid_rnd_N|exact G].
  rewrite Rlt_bool_true; [intros (A & B & _); now rewrite A|].
  unfold F2R, Fnum, Fexp; rewrite Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0.
  apply Rlt_le_trans with (bpow radix2 53 * bpow radix2 e).
  - apply Rmult_lt_compat_r; [apply bpow_gt_0|]. change (bpow radix2 53) with (IZR (2 ^ 53)). now apply IZR_lt.
  - rewrite <- bpow_plus; apply bpow_le; lia.
Qed.

(** ** Finite results come from finite operands *)

Lemma val_format x : format (val x).
Proof. exact (generic_format_B2R 53 1024 x). Qed.
#[global] Hint Resolve val_format : core.

Lemma val_lt_max x : Rabs (val x) < bpow radix2 1024.
Proof. exact (abs_B2R_lt_emax 53 1024 x). Qed.

Lemma overflow_infinite x s : B2FF 53 1024 x = binary_overflow 53 1024 mode_NE s -> x = B754_infinity 53 1024 s.
Proof. destruct x; simpl; unfold binary_overflow; simpl; try discriminate. now injection 1; intros ->. Qed.

Lemma fadd_total x y : finite x -> finite y ->
  (finite (x + y)%D /\ val (x + y)%D = rnd (val x + val y)) \/
  (x + y = B754_infinity 53 1024 false)%D /\ bpow radix2 1024 <= rnd (val x + val y) \/
  (x + y = B754_infinity 53 1024 true)%D /\ rnd (val x + val y) <= - bpow radix2 1024.
Proof.
  intros Fx Fy.
  generalize (Bplus_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y Fx Fy).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  fold (b64_plus mode_NE x y).
  case Rlt_bool_spec; intros H.
  - intros (A & B & _); left; now split.
  - intros (A & S); right. apply overflow_infinite in A. fold (fadd x y) in A. unfold fadd at 1 2.
    change (b64_plus mode_NE x y = B754_infinity 53 1024 (Bsign 53 1024 x)) in A. rewrite A.
    assert (V : forall s z, finite z -> Bsign 53 1024 z = s -> if s then val z <= 0 else 0 <= val z).
    { intros s z Fz <-; destruct z; simpl; try discriminate; try (destruct s; lra).
      destruct s; unfold F2R; simpl.
      - apply Ropp_le_cancel; rewrite Ropp_0. rewrite <- Ropp_mult_distr_l_reverse, <- opp_IZR. simpl.
        apply Rmult_le_pos; [now apply IZR_le|apply bpow_ge_0].
      - apply Rmult_le_pos; [now apply IZR_le|apply bpow_ge_0]. }
    pose proof (V _ x Fx eq_refl) as Vx; pose proof (V _ y Fy (eq_sym S)) as Vy.
    destruct (Bsign 53 1024 x).
    + right; split; [reflexivity|].
      assert (rnd (val x + val y) <= 0).
      { rewrite <- (round_0 radix2 fexp ZnearestE); apply round_le; try typeclasses eauto; lra. }
      rewrite Rabs_left1 in H by assumption; lra.
    + left; split; [reflexivity|].
      assert (0 <= rnd (val x + val y)).
      { rewrite <- (round_0 radix2 fexp ZnearestE); apply round_le; try typeclasses eauto; lra. }
      rewrite Rabs_pos_eq in H by assumption; lra.
Qed.

Lemma fadd_inv x y : finite (x + y)%D -> finite x /\ finite y /\ val (x + y)%D = rnd (val x + val y).
Proof.
  intros H.
  assert (F : finite x /\ finite y).
  { destruct x as [sx|sx|sx px Hx|sx mx ex Hx]; destruct y as [sy|sy|sy py Hy|sy my ey Hy]; try (now split);
      revert H; unfold fadd, b64_plus, Bplus, BSN2B; simpl; try discriminate; destruct (eqb sx sy); discriminate. }
  destruct F as [Fx Fy]; split; [exact Fx|split; [exact Fy|]].
  destruct (fadd_total x y Fx Fy) as [[_ E]|[[E _]|[E _]]]; [exact E|rewrite E in H; discriminate..].
Qed.

Lemma fopp_finite x : is_finite 53 1024 (- x)%D = is_finite 53 1024 x.
Proof. apply is_finite_Bopp. Qed.
Lemma fopp_val x : val (- x)%D = - val x.
Proof. apply B2R_Bopp. Qed.

Lemma fabs_finite x : is_finite 53 1024 (fabs x) = is_finite 53 1024 x.
Proof. apply is_finite_Babs. Qed.
Lemma fabs_val x : val (fabs x) = Rabs (val x).
Proof. apply B2R_Babs. Qed.

Lemma fsub_total x y : finite x -> finite y ->
  (finite (x - y)%D /\ val (x - y)%D = rnd (val x - val y)) \/
  (x - y = B754_infinity 53 1024 false)%D /\ bpow radix2 1024 <= rnd (val x - val y) \/
  (x - y = B754_infinity 53 1024 true)%D /\ rnd (val x - val y) <= - bpow radix2 1024.
Proof.
  intros Fx Fy.
  generalize (Bminus_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y Fx Fy).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  fold (b64_minus mode_NE x y).
  case Rlt_bool_spec; intros H.
  - intros (A & B & _); left; now split.
  - intros (A & S); right. apply overflow_infinite in A.
    change (b64_minus mode_NE x y) with (x - y)%D in A. rewrite A.
    assert (V : forall s z, finite z -> Bsign 53 1024 z = s -> if s then val z <= 0 else 0 <= val z).
    { intros s z Fz <-; destruct z as [s|s|s p Hp|s m e He]; simpl; try discriminate; try (destruct s; lra).
      destruct s; [apply F2R_le_0|apply F2R_ge_0]; simpl; lia. }
    pose proof (V _ x Fx eq_refl) as Vx; pose proof (V _ y Fy eq_refl) as Vy. rewrite S in *.
    destruct (Bsign 53 1024 y); simpl in *.
    + left; split; [reflexivity|].
      assert (0 <= rnd (val x - val y)).
      { rewrite <- (round_0 radix2 fexp ZnearestE); apply round_le; try typeclasses eauto; lra. }
      rewrite Rabs_pos_eq in H by assumption; lra.
    + right; split; [reflexivity|].
      assert (rnd (val x - val y) <= 0).
      { rewrite <- (round_0 radix2 fexp ZnearestE); apply round_le; try typeclasses eauto; lra. }
      rewrite Rabs_left1 in H by assumption; lra.
Qed.

Lemma fsub_inv x y : finite (x - y)%D -> finite x /\ finite y /\ val (x - y)%D = rnd (val x - val y).
Proof.
  intros H.
  assert (F : finite x /\ finite y).
  { destruct x as [sx|sx|sx px Hx|sx mx ex Hx]; destruct y as [sy|sy|sy py Hy|sy my ey Hy]; try (now split);
      revert H; unfold fsub, b64_minus, Bminus, BSN2B; simpl; try discriminate; destruct (eqb sx (negb sy));
        discriminate. }
  destruct F as [Fx Fy]; split; [exact Fx|split; [exact Fy|]].
  destruct (fsub_total x y Fx Fy) as [[_ E]|[[E _]|[E _]]]; [exact E|rewrite E in H; discriminate..].
Qed.

Lemma fmul_inv x y : finite (x * y)%D -> finite x /\ finite y /\ val (x * y)%D = rnd (val x * val y).
Proof.
  intros H.
  assert (F : finite x /\ finite y).
  { destruct x as [sx|sx|sx px Hx|sx mx ex Hx]; destruct y as [sy|sy|sy py Hy|sy my ey Hy]; try (now split);
      revert H; unfold fmul, b64_mult, Bmult, BSN2B; simpl; discriminate. }
  destruct F as [Fx Fy]; split; [exact Fx|split; [exact Fy|]].
  generalize (Bmult_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  fold (b64_mult mode_NE x y); change (b64_mult mode_NE x y) with (x * y)%D.
  case Rlt_bool_spec; intros K.
  - now intros (A & _).
  - intros A; apply overflow_infinite in A; rewrite A in H; discriminate.
Qed.

Lemma fmul_finite x y : finite x -> finite y -> Rabs (rnd (val x * val y)) < bpow radix2 1024 ->
  finite (x * y)%D /\ val (x * y)%D = rnd (val x * val y).
Proof.
  intros Fx Fy K.
  generalize (Bmult_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  fold (b64_mult mode_NE x y); change (b64_mult mode_NE x y) with (x * y)%D.
  rewrite Rlt_bool_true by exact K. intros (A & B & _). rewrite Fx, Fy in B. now split.
Qed.

Lemma fadd_finite x y : finite x -> finite y -> Rabs (rnd (val x + val y)) < bpow radix2 1024 ->
  finite (x + y)%D /\ val (x + y)%D = rnd (val x + val y).
Proof.
  intros Fx Fy K; destruct (fadd_total x y Fx Fy) as [A|[[_ A]|[_ A]]]; [exact A|exfalso..].
  - generalize (Rle_abs (rnd (val x + val y))); lra.
  - rewrite Rabs_left1 in K; generalize (bpow_gt_0 radix2 1024); lra.
Qed.

Lemma fsub_finite x y : finite x -> finite y -> Rabs (rnd (val x - val y)) < bpow radix2 1024 ->
  finite (x - y)%D /\ val (x - y)%D = rnd (val x - val y).
Proof.
  intros Fx Fy K; destruct (fsub_total x y Fx Fy) as [A|[[_ A]|[_ A]]]; [exact A|exfalso..].
  - generalize (Rle_abs (rnd (val x - val y))); lra.
  - rewrite Rabs_left1 in K; generalize (bpow_gt_0 radix2 1024); lra.
Qed.

Lemma fsqrt_inv x : finite (fsqrt x) -> finite x /\ 0 <= val x /\ val (fsqrt x) = rnd (sqrt (val x)).
Proof.
  generalize (Bsqrt_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_NE x).
  fold (b64_sqrt mode_NE x); change (b64_sqrt mode_NE x) with (fsqrt x).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  intros (A & B & _) H. rewrite B in H.
  destruct x as [sx|sx|sx px Hx|[|] mx ex Hx]; try discriminate; (split; [reflexivity|split; [|exact A]]).
  - simpl; lra.
  - apply F2R_ge_0; simpl; lia.
Qed.

(** ** Comparisons *)

Lemma gt_finite x y : finite x -> finite y -> gt x y = true <-> val y < val x.
Proof.
  intros Fx Fy; unfold gt, b64_compare; rewrite Bcompare_correct by assumption.
  case Rcompare_spec; intros H; split; intros K; try discriminate; try reflexivity; lra.
Qed.
Lemma lt_finite x y : finite x -> finite y -> lt x y = true <-> val x < val y.
Proof.
  intros Fx Fy; unfold lt, b64_compare; rewrite Bcompare_correct by assumption.
  case Rcompare_spec; intros H; split; intros K; try discriminate; try reflexivity; lra.
Qed.
Lemma le_finite x y : finite x -> finite y -> le x y = true <-> val x <= val y.
Proof.
  intros Fx Fy; unfold le, b64_compare; rewrite Bcompare_correct by assumption.
  case Rcompare_spec; intros H; split; intros K; try discriminate; try reflexivity; lra.
Qed.

(** A sum or difference that overflows still compares as its exact value does. *)
Lemma fadd_gt x y e : finite x -> finite y -> finite e -> gt (x + y) e = true -> val e < rnd (val x + val y).
Proof.
  intros Fx Fy Fe H; generalize (val_lt_max e) (Rle_abs (val e)); intros V1 V2.
  destruct (fadd_total x y Fx Fy) as [[F E]|[[_ A]|[E A]]].
  - rewrite <- E; now apply gt_finite.
  - lra.
  - rewrite E in H; destruct e; discriminate.
Qed.
Lemma fsub_gt x y e : finite x -> finite y -> finite e -> gt (x - y) e = true -> val e < rnd (val x - val y).
Proof.
  intros Fx Fy Fe H; generalize (val_lt_max e) (Rle_abs (val e)); intros V1 V2.
  destruct (fsub_total x y Fx Fy) as [[F E]|[[_ A]|[E A]]].
  - rewrite <- E; now apply gt_finite.
  - lra.
  - rewrite E in H; destruct e; discriminate.
Qed.
Lemma fsub_lt x y e : finite x -> finite y -> finite e -> lt (x - y) e = true -> rnd (val x - val y) < val e.
Proof.
  intros Fx Fy Fe H; generalize (val_lt_max e) (Rle_abs (- val e)); rewrite Rabs_Ropp; intros V1 V2.
  destruct (fsub_total x y Fx Fy) as [[F E]|[[E A]|[_ A]]].
  - rewrite <- E; now apply lt_finite.
  - rewrite E in H; destruct e; discriminate.
  - lra.
Qed.
Lemma fadd_lt x y e : finite x -> finite y -> finite e -> lt (x + y) e = true -> rnd (val x + val y) < val e.
Proof.
  intros Fx Fy Fe H; generalize (val_lt_max e) (Rle_abs (- val e)); rewrite Rabs_Ropp; intros V1 V2.
  destruct (fadd_total x y Fx Fy) as [[F E]|[[E A]|[_ A]]].
  - rewrite <- E; now apply lt_finite.
  - rewrite E in H; destruct e; discriminate.
  - lra.
Qed.

(** ** Values that are not negative, or are NaN *)

Definition nneg (x : double) : Prop :=
  match x with B754_infinity _ _ s => s = false | B754_finite _ _ s _ _ _ => s = false | _ => True end.

Lemma nneg_val x : nneg x -> 0 <= val x.
Proof.
  destruct x as [s|s|s p H|s m e H]; simpl; try lra. intros ->. apply F2R_ge_0; simpl; lia.
Qed.
Lemma nneg_of_val x : finite x -> 0 <= val x -> nneg x.
Proof.
  destruct x as [s|s|s p H|[|] m e H]; simpl; try discriminate; try easy.
  intros _ V; exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia).
  simpl in V; lra.
Qed.
(** Only a bound that is finite can be exceeded. *)
Lemma gt_nneg_finite d e : nneg e -> gt d e = true -> finite e.
Proof.
  destruct e as [s|s|s p H|s m e H]; simpl; try reflexivity.
  - intros ->; destruct d as [?|[|]|?|?]; discriminate.
  - destruct d; discriminate.
Qed.
Lemma lt_opp_nneg_finite d e : nneg e -> lt d (- e) = true -> finite e.
Proof.
  destruct e as [s|s|s p H|s m e H]; simpl; try reflexivity.
  - intros ->; destruct d as [?|[|]|?|?]; discriminate.
  - unfold fopp, b64_opp, Bopp, build_nan; simpl. destruct d; discriminate.
Qed.

Lemma rnd_ge_0 x : 0 <= x -> 0 <= rnd x.
Proof. intros H; rewrite <- (round_0 radix2 fexp ZnearestE); apply round_le; try typeclasses eauto; exact H. Qed.

Lemma nneg_add x y : nneg x -> nneg y -> nneg (x + y).
Proof.
  intros Nx Ny.
  destruct (is_finite 53 1024 x) eqn:Fx; [destruct (is_finite 53 1024 y) eqn:Fy|].
  - pose proof (nneg_val _ Nx); pose proof (nneg_val _ Ny).
    assert (0 <= rnd (val x + val y)) by (apply rnd_ge_0; lra).
    destruct (fadd_total x y Fx Fy) as [[F E]|[[E _]|[_ A]]].
    + apply nneg_of_val; [exact F|]; now rewrite E.
    + now rewrite E.
    + exfalso; generalize (bpow_gt_0 radix2 1024); lra.
  - destruct y as [s|s|s p H|s m e H]; try discriminate; simpl in Ny; [subst s|];
      destruct x as [sx|sx|sx px Hx|sx mx ex Hx]; try discriminate; simpl; easy.
  - destruct x as [s|s|s p H|s m e H]; try discriminate; simpl in Nx; [subst s|];
      destruct y as [sx|sx|sx px Hx|sx mx ex Hx]; simpl in *; try subst; simpl; easy.
Qed.

Lemma nneg_mul x y : nneg x -> nneg y -> nneg (x * y).
Proof.
  intros Nx Ny.
  destruct (is_finite 53 1024 x) eqn:Fx; [destruct (is_finite 53 1024 y) eqn:Fy|].
  - pose proof (nneg_val _ Nx); pose proof (nneg_val _ Ny).
    assert (R0 : 0 <= rnd (val x * val y)) by (apply rnd_ge_0; now apply Rmult_le_pos).
    destruct (Rlt_or_le (Rabs (rnd (val x * val y))) (bpow radix2 1024)) as [K|K].
    + destruct (fmul_finite x y Fx Fy K) as [F E]. apply nneg_of_val; [exact F|]; now rewrite E.
    + generalize (Bmult_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y).
      change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
      fold (b64_mult mode_NE x y); change (b64_mult mode_NE x y) with (x * y)%D.
      rewrite Rlt_bool_false by exact K. intros A; apply overflow_infinite in A; rewrite A; simpl.
      assert (Z : rnd (val x * val y) <> 0).
      { intros Z; rewrite Z, Rabs_R0 in K; generalize (bpow_gt_0 radix2 1024); lra. }
      destruct x as [sx|sx|sx px Hx|sx mx ex Hx]; destruct y as [sy|sy|sy py Hy|sy my ey Hy]; try discriminate;
        simpl in *; try (exfalso; apply Z; rewrite ?Rmult_0_l, ?Rmult_0_r; apply round_0; typeclasses eauto).
      now subst.
  - destruct y as [s|s|s p H|s m e H]; try discriminate; simpl in Ny; [subst s|];
      destruct x as [sx|sx|sx px Hx|sx mx ex Hx]; try discriminate; simpl in *; try subst; simpl; easy.
  - destruct x as [s|s|s p H|s m e H]; try discriminate; simpl in Nx; [subst s|];
      destruct y as [sx|sx|sx px Hx|sx mx ex Hx]; simpl in *; try subst; simpl; easy.
Qed.

Lemma nneg_abs x : nneg (fabs x).
Proof. destruct x as [s|s|s p H|s m e H]; simpl; easy. Qed.

Lemma nneg_sqr x : nneg (x * x).
Proof.
  destruct (is_finite 53 1024 x) eqn:Fx.
  - destruct (Rlt_or_le (Rabs (rnd (val x * val x))) (bpow radix2 1024)) as [K|K].
    + destruct (fmul_finite x x Fx Fx K) as [F E]. apply nneg_of_val; [exact F|]; rewrite E.
      apply rnd_ge_0. nra.
    + generalize (Bmult_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x x).
      change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
      fold (b64_mult mode_NE x x); change (b64_mult mode_NE x x) with (x * x)%D.
      rewrite Rlt_bool_false by exact K. intros A; apply overflow_infinite in A; rewrite A; simpl.
      apply xorb_nilpotent.
  - destruct x as [s|s|s p H|s m e H]; try discriminate; simpl; [apply xorb_nilpotent|easy].
Qed.

Lemma fsqr_total x : finite x ->
  (finite (x * x)%D /\ val (x * x)%D = rnd (val x * val x)) \/
  (x * x = B754_infinity 53 1024 false)%D /\ bpow radix2 1024 <= rnd (val x * val x).
Proof.
  intros Fx. assert (R0 : 0 <= rnd (val x * val x)) by (apply rnd_ge_0, Rle_0_sqr).
  destruct (Rlt_or_le (Rabs (rnd (val x * val x))) (bpow radix2 1024)) as [K|K].
  - left. now apply fmul_finite.
  - right. split; [|now rewrite Rabs_pos_eq in K].
    generalize (Bmult_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x x).
    change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
    fold (b64_mult mode_NE x x); change (b64_mult mode_NE x x) with (x * x)%D.
    rewrite Rlt_bool_false by exact K. rewrite xorb_nilpotent. intros A; now apply overflow_infinite in A.
Qed.

(** A positive constant times an infinite or finite value. *)
Lemma fmul_total_pos x y : finite x -> finite y -> 0 <= val x -> 0 < val y ->
  (finite (x * y)%D /\ val (x * y)%D = rnd (val x * val y)) \/
  (x * y = B754_infinity 53 1024 false)%D /\ bpow radix2 1024 <= rnd (val x * val y).
Proof.
  intros Fx Fy Px Py. assert (R0 : 0 <= rnd (val x * val y)) by (apply rnd_ge_0, Rmult_le_pos; lra).
  destruct (Rlt_or_le (Rabs (rnd (val x * val y))) (bpow radix2 1024)) as [K|K].
  - left. now apply fmul_finite.
  - right. split; [|now rewrite Rabs_pos_eq in K].
    assert (Nx : nneg x) by now apply nneg_of_val. assert (Ny : nneg y) by (apply nneg_of_val; [exact Fy|lra]).
    assert (N : nneg (x * y)%D) by now apply nneg_mul.
    generalize (Bmult_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y).
    change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
    fold (b64_mult mode_NE x y); change (b64_mult mode_NE x y) with (x * y)%D.
    rewrite Rlt_bool_false by exact K. intros A; apply overflow_infinite in A. rewrite A in *. simpl in N.
    now rewrite N.
Qed.

Lemma inf_mul_pos y : finite y -> 0 < val y ->
  (B754_infinity 53 1024 false * y)%D = B754_infinity 53 1024 false.
Proof.
  intros F P. destruct y as [s|s|s p H|[|] m e H]; try discriminate F; [simpl in P; lra| |reflexivity].
  exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in P. lra.
Qed.

Lemma nneg_sqrt x : nneg (fsqrt x).
Proof.
  generalize (Bsqrt_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_NE x).
  fold (b64_sqrt mode_NE x); change (b64_sqrt mode_NE x) with (fsqrt x).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  intros (A & B & _).
  destruct x as [sx|[|]|sx px Hx|[|] mx ex Hx]; try easy.
  apply nneg_of_val; [exact B|]. rewrite A. apply rnd_ge_0, sqrt_pos.
Qed.

Lemma nneg_lit c : is_double c = true -> (0 <= fst c)%Z -> nneg (lit c).
Proof.
  intros H P; destruct (lit_correct c H) as [F V]. apply nneg_of_val; [exact F|rewrite V].
  unfold cval; apply Rmult_le_pos; [now apply IZR_le|apply bpow_ge_0].
Qed.

(** The three-way answer of a filter. *)
Definition answer (d e : double) : Z := if gt d e then 1%Z else if lt d (- e) then (-1)%Z else 0%Z.

Lemma answer_correct d e (P N : Prop) : nneg e ->
  (finite e -> gt d e = true -> P) -> (finite e -> lt d (- e) = true -> N) ->
  (answer d e = 1%Z -> P) /\ (answer d e = (-1)%Z -> N).
Proof.
  intros Ne HP HN; unfold answer; destruct (gt d e) eqn:G; [|destruct (lt d (- e)) eqn:L]; (split; [|]);
    try discriminate.
  - intros _; apply HP; [now apply gt_nneg_finite with d|reflexivity].
  - intros _; apply HN; [now apply lt_opp_nneg_finite with d|reflexivity].
Qed.

(** Values of constants in a hypothesis. *)
Ltac lits H :=
  repeat match type of H with context [B2R 53 1024 (lit ?c)] => rewrite (proj2 (lit_correct c eq_refl)) in H end.
(** Arithmetic with infinity. *)
Lemma inf_sqr : (B754_infinity 53 1024 false * B754_infinity 53 1024 false)%D = B754_infinity 53 1024 false.
Proof. reflexivity. Qed.
Lemma inf_inf : (B754_infinity 53 1024 false + B754_infinity 53 1024 false)%D = B754_infinity 53 1024 false.
Proof. reflexivity. Qed.
Lemma inf_add x : finite x -> (B754_infinity 53 1024 false + x)%D = B754_infinity 53 1024 false.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma add_inf x : finite x -> (x + B754_infinity 53 1024 false)%D = B754_infinity 53 1024 false.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma inf_sub x : finite x -> (B754_infinity 53 1024 false - x)%D = B754_infinity 53 1024 false.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma sub_inf x : finite x -> (x - B754_infinity 53 1024 false)%D = B754_infinity 53 1024 true.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma ninf_sub x : finite x -> (B754_infinity 53 1024 true - x)%D = B754_infinity 53 1024 true.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma sub_ninf x : finite x -> (x - B754_infinity 53 1024 true)%D = B754_infinity 53 1024 false.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma inf_sub_ninf : (B754_infinity 53 1024 false - B754_infinity 53 1024 true)%D = B754_infinity 53 1024 false.
Proof. reflexivity. Qed.
Lemma ninf_sub_inf : (B754_infinity 53 1024 true - B754_infinity 53 1024 false)%D = B754_infinity 53 1024 true.
Proof. reflexivity. Qed.
Lemma gt_of_inf x : finite x -> gt (B754_infinity 53 1024 false) x = true.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma ninf_add x : finite x -> (B754_infinity 53 1024 true + x)%D = B754_infinity 53 1024 true.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma le_inf x : finite x -> le (B754_infinity 53 1024 false) x = false.
Proof. destruct x; try discriminate; reflexivity. Qed.
Lemma le_add_inf f x : finite x -> le (f + B754_infinity 53 1024 false)%D x = false.
Proof. destruct f as [|[|]| |]; destruct x; try discriminate; reflexivity. Qed.
Lemma gt_sub_inf f x : finite x -> gt (f - B754_infinity 53 1024 false)%D x = false.
Proof. destruct f as [|[|]| |]; destruct x; try discriminate; reflexivity. Qed.
Lemma gt_ninf x : finite x -> gt (B754_infinity 53 1024 true) x = false.
Proof. destruct x; try discriminate; reflexivity. Qed.
#[global] Opaque fadd fsub fmul fdiv fsqrt fopp fabs lit.
