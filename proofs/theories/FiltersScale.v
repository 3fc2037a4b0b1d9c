(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-SCALE] From the common scale back to user coordinates, outward: division by a denominator that is known as a
    double, or is too large for one. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersInterval FiltersIntervalRoot
  FiltersDirection.
Open Scope R_scope.

(* [FLT-SCALE] src/skeleton/rects_filter.c: x += (k & 1 ? 1 : -1) * {} * fabs(x); *)
Definition c_scale : const := (1, -50)%Z.

(* C src/skeleton/rects_filter.c dyd_scale_to_user
  double l = mpz_get_d(s->lcm);
  if (l == 1) return;
  for (int k = 0; k < 4; k++) {
    double x = box->e[k] / l, out = k & 1 ? INFINITY : -INFINITY;
    x += (k & 1 ? 1 : -1) * 4 * 0x1p-52 * fabs(x);
    box->e[k] = isnan(x) || !isfinite(l) ? out : nextafter(x, out);
  }
*)
Definition user_upper (e l : double) : double :=
  let q := (e / l)%D in let x := (q + lit c_scale * fabs q)%D in
  if is_nan 53 1024 x || negb (is_finite 53 1024 l) then inf else b64_succ x.
Definition user_lower (e l : double) : double :=
  let q := (e / l)%D in let x := (q + - lit c_scale * fabs q)%D in
  if is_nan 53 1024 x || negb (is_finite 53 1024 l) then ninf else b64_pred x.

(** ** The doubles next to one *)

Lemma succ_step x : format x -> x + 2 * eta <= succ radix2 fexp x.
Proof.
  intros F. assert (E : forall y, 2 * eta <= ulp radix2 fexp y).
  { intros y. replace (2 * eta) with (ulp radix2 fexp 0); [apply ulp_ge_ulp_0; typeclasses eauto|].
    rewrite ulp_FLT_small; [|reflexivity|rewrite Rabs_R0; apply bpow_gt_0].
    rewrite bpow_eta. change (bpow radix2 (-1074 + 1075)) with 2. reflexivity. }
  destruct (Rle_or_lt 0 x) as [P|N].
  - rewrite succ_eq_pos by exact P. generalize (E x). lra.
  - assert (FO : format (- x)) by now apply format_opp.
    assert (P0 : 0 <= pred radix2 fexp (- x)) by (apply pred_ge_0; [typeclasses eauto|lra|exact FO]).
    pose proof (succ_pred radix2 fexp (- x) FO) as S. rewrite succ_eq_pos in S by exact P0.
    generalize (E (pred radix2 fexp (- x))). unfold pred in *. rewrite Ropp_involutive in *. lra.
Qed.

Section Next.
Lemma next_up x : finite x -> b64_succ x = inf \/ (finite (b64_succ x) /\ val x + 2 * eta <= val (b64_succ x)).
Proof.
  intros F.
  generalize (Bsucc_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) x F).
  change (SpecFloat.fexp 53 1024) with fexp. fold (b64_succ x). case Rlt_bool_spec; intros _ H.
  - destruct H as (V & G & _). change (Bsucc 53 1024 _ _ x) with (b64_succ x) in V, G.
    right. split; [exact G|]. rewrite V. apply succ_step, val_format.
  - left. change (Bsucc 53 1024 _ _ x) with (b64_succ x) in H. destruct (b64_succ x) as [|[|]| |]; try discriminate.
    reflexivity.
Qed.
Lemma next_down x : finite x -> b64_pred x = ninf \/ (finite (b64_pred x) /\ val (b64_pred x) <= val x - 2 * eta).
Proof.
  intros F.
  generalize (Bpred_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) x F).
  change (SpecFloat.fexp 53 1024) with fexp. case Rlt_bool_spec; intros _ H.
  - destruct H as (V & G & _). change (Bpred 53 1024 _ _ x) with (b64_pred x) in V, G.
    right. split; [exact G|]. rewrite V. unfold pred.
    pose proof (succ_step (- val x) (format_opp _ (val_format x))). lra.
  - left. change (Bpred 53 1024 _ _ x) with (b64_pred x) in H. destruct (b64_pred x) as [|[|]| |]; try discriminate.
    reflexivity.
Qed.
Lemma next_up_inf : b64_succ inf = inf.
Proof. reflexivity. Qed.
Lemma next_down_ninf : b64_pred ninf = ninf.
Proof. reflexivity. Qed.
Local Transparent fadd fmul fdiv fabs fopp lit.
Lemma infinite_step s : ((B754_infinity 53 1024 s) + (if s then - lit c_scale else lit c_scale) * fabs (B754_infinity 53
  1024 s))%D = B754_infinity 53 1024 s.
Proof. destruct s; vm_compute; reflexivity. Qed.
Lemma infinite_div s l : finite l -> 1 <= val l -> (B754_infinity 53 1024 s / l)%D = B754_infinity 53 1024 s.
Proof.
  intros F H. destruct l as [t|t|t q Hq|[|] m e He]; try discriminate; [simpl in H; lra| |destruct s; reflexivity].
  exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in H. lra.
Qed.
Lemma fdiv_finite x y : finite x -> finite y -> 1 <= val y -> finite (x / y)%D /\ val (x / y)%D = rnd (val x / val y).
Proof.
  intros Fx Fy H.
  generalize (Bdiv_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x y ltac:(lra)).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  fold (b64_div mode_NE x y); change (b64_div mode_NE x y) with (x / y)%D.
  rewrite Rlt_bool_true.
  - intros (A & B & _). rewrite B. now split.
  - rewrite <- rnd_abs. apply Rle_lt_trans with (Rabs (val x)); [|apply val_lt_max].
    rewrite <- (rnd_id (Rabs (val x))) by (apply generic_format_abs, val_format). apply rnd_le.
    unfold Rdiv. rewrite Rabs_mult. rewrite <- (Rmult_1_r (Rabs (val x))) at 2. apply Rmult_le_compat_l; [apply Rabs_pos|].
    rewrite Rabs_inv, Rabs_pos_eq by lra. rewrite <- Rinv_1. apply Rinv_le_contravar; lra.
Qed.
End Next.

(** ** The rounding *)

(** l is lcm cut to 53 bits. *)
Lemma scaled_up y E l L : y <= E -> 1 <= l -> l <= L -> L <= l * (1 + 2 * u) ->
  y / L <= rnd (rnd (E / l) + rnd (cval c_scale * Rabs (rnd (E / l)))) + 2 * eta.
Proof.
  intros HE Hl LL LU. pose proof eta_pos as EP.
  assert (C : cval c_scale = 8 * u) by (unfold c_scale, u; numerals; lra). rewrite C.
  assert (YL : y / L <= E / L) by (apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; lra|exact HE]).
  set (Z := E / l). assert (EZ : E = Z * l) by (unfold Z; field; lra).
  assert (Bnd : E / L <= Rmax Z (Z * (1 - 2 * u))).
  { destruct (Rle_or_lt 0 Z) as [P|N].
    - apply Rle_trans with Z; [|apply Rmax_l]. apply Rmult_le_reg_r with L; [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r, EZ by lra. apply Rmult_le_compat_l; assumption.
    - apply Rle_trans with (Z * (1 - 2 * u)); [|apply Rmax_r]. apply Rmult_le_reg_r with L; [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r, EZ by lra.
      assert (- Z * ((1 - 2 * u) * L) <= - Z * l); [|lra]. apply Rmult_le_compat_l; [lra|].
      assert ((1 - 2 * u) * L <= (1 - 2 * u) * (l * (1 + 2 * u))) by (apply Rmult_le_compat_l; [unfold u|]; lra).
      unfold u in *. lra. }
  set (q := rnd Z). pose proof (rnd_error Z) as Eq. fold q in Eq.
  pose proof (Rabs_pos q) as Pq.
  assert (T : 8 * u * Rabs q * (1 - u) - eta <= rnd (8 * u * Rabs q)) by (apply rnd_lower, Rmult_le_pos; [unfold u; lra|exact
    Pq]).
  assert (T0 : 0 <= rnd (8 * u * Rabs q)) by (apply rnd_pos, Rmult_le_pos; [unfold u; lra|exact Pq]).
  assert (T1 : rnd (8 * u * Rabs q) <= 8 * u * Rabs q * (1 + u) + eta) by (apply rnd_upper, Rmult_le_pos; [unfold u;
    lra|exact Pq]).
  set (t := rnd (8 * u * Rabs q)) in *.
  pose proof (rnd_add_error q t (rnd_format _) (rnd_format _)) as Ex.
  assert (Mono : q <= rnd (q + t)).
  { rewrite <- (rnd_id q) at 1 by apply rnd_format. apply rnd_le. lra. }
  set (x := rnd (q + t)) in *.
  destruct (Rle_or_lt 0 Z) as [P|N].
  - rewrite Rmax_left in Bnd by (assert (0 <= Z * (2 * u)) by (apply Rmult_le_pos; unfold u; lra); lra).
    assert (Q0 : 0 <= q) by (apply rnd_pos; exact P).
    rewrite (Rabs_pos_eq Z) in Eq by exact P. rewrite (Rabs_pos_eq q) in T, T1 by exact Q0.
    rewrite (Rabs_pos_eq (q + t)) in Ex by lra.
    apply Rabs_le_inv in Eq. apply Rabs_le_inv in Ex.
    destruct (Rle_or_lt Z (10 * eta)) as [S|S]; unfold u in *; lra.
  - rewrite Rmax_right in Bnd by (assert (0 <= - Z * (2 * u)) by (apply Rmult_le_pos; unfold u; lra); lra).
    assert (Q0 : q <= 0) by (rewrite <- (round_0 radix2 fexp ZnearestE); apply rnd_le; lra).
    rewrite (Rabs_left1 Z) in Eq by lra. rewrite (Rabs_left1 q) in T, T1 by exact Q0.
    assert (Ex' : Rabs (x - (q + t)) <= u * (- q + t)).
    { apply Rle_trans with (1 := Ex). apply Rmult_le_compat_l; [unfold u; lra|]. apply Rabs_le. lra. }
    apply Rabs_le_inv in Eq. apply Rabs_le_inv in Ex'. unfold u in *; lra.
Qed.

(** ** The theorem *)

(** What mpz_get_d gives of an integer: cut to 53 bits, infinite when too large. *)
Definition cut_to_double (l : double) (L : R) : Prop :=
  l = inf \/ (finite l /\ 1 <= val l <= L /\ L <= val l * (1 + 2 * u)).

Theorem user_upper_correct e l y L : upper_end e y -> cut_to_double l L -> upper_end (user_upper e l) (y / L).
Proof.
  intros He Hl. unfold user_upper. cbv zeta. set (x := (e / l + lit c_scale * fabs (e / l))%D).
  destruct (is_nan 53 1024 x) eqn:Nx; [left; reflexivity|]. cbn [orb].
  destruct Hl as [->|(Fl & [L1 L2] & L3)]; [left; reflexivity|]. rewrite Fl. cbn [negb].
  destruct He as [->|[Fe He]].
  { left. unfold x. rewrite infinite_div by assumption. rewrite (infinite_step false). exact next_up_inf. }
  destruct (fdiv_finite e l Fe Fl L1) as [Fq Eq].
  destruct (lit_correct c_scale eq_refl) as [Fc Ec].
  destruct (cases x) as [F|[F|[F|F]]]; [|congruence|left; rewrite F; exact next_up_inf|].
  - destruct (next_up x F) as [E|[G V]]; [now left|right]. split; [exact G|]. apply Rle_trans with (2 := V).
    unfold x in *. destruct (fadd_inv _ _ F) as (_ & F2 & E). destruct (fmul_inv _ _ F2) as (_ & _ & E2).
    rewrite E, E2, Ec, fabs_val, Eq. now apply scaled_up.
  - exfalso. revert F. apply add_not_ninf.
    + apply nneg_mul; [apply nneg_lit; [reflexivity|simpl; lia]|apply nneg_abs].
    + intros E. rewrite E in Fq. discriminate.
Qed.

Theorem user_lower_correct e l y L : lower_end e y -> cut_to_double l L -> lower_end (user_lower e l) (y / L).
Proof.
  intros He Hl. unfold user_lower. cbv zeta. set (x := (e / l + - lit c_scale * fabs (e / l))%D).
  destruct (is_nan 53 1024 x) eqn:Nx; [left; reflexivity|]. cbn [orb].
  destruct Hl as [->|(Fl & [L1 L2] & L3)]; [left; reflexivity|]. rewrite Fl. cbn [negb].
  destruct He as [->|[Fe He]].
  { left. unfold x. rewrite infinite_div by assumption. rewrite (infinite_step true). exact next_down_ninf. }
  destruct (fdiv_finite e l Fe Fl L1) as [Fq Eq].
  destruct (lit_correct c_scale eq_refl) as [Fc Ec].
  assert (C : cval c_scale = 8 * u) by (unfold c_scale, u; numerals; lra).
  destruct (fmul_finite (- lit c_scale)%D (fabs (e / l))%D) as [Ft Et].
  { now rewrite fopp_finite. } { now rewrite fabs_finite. }
  { rewrite fopp_val, fabs_val, Ec. apply Rle_lt_trans with (Rabs (val (e / l)%D)); [|apply val_lt_max].
    rewrite <- rnd_abs. rewrite <- (rnd_id (Rabs (val (e / l)%D))) at 2 by (apply generic_format_abs, val_format).
    apply rnd_le. rewrite Rabs_mult, Rabs_Rabsolu, Rabs_Ropp, C. rewrite <- (Rmult_1_l (Rabs (val (e / l)%D))) at 2.
    apply Rmult_le_compat_r; [apply Rabs_pos|]. rewrite Rabs_pos_eq; unfold u; lra. }
  rewrite fopp_val, fabs_val, Ec in Et.
  replace (- cval c_scale * Rabs (val (e / l)%D)) with (- (cval c_scale * Rabs (val (e / l)%D))) in Et by ring.
  rewrite round_NE_opp in Et.
  destruct (fadd_total _ _ Fq Ft) as [[F E]|[[_ A]|[E _]]].
  - destruct (next_down x F) as [G|[G V]]; [now left|right]. split; [exact G|]. apply Rle_trans with (1 := V).
    unfold x. rewrite E, Et, Eq.
    pose proof (scaled_up (- y) (- val e) (val l) L ltac:(lra) L1 L2 L3) as S.
    replace (- val e / val l) with (- (val e / val l)) in S by (field; lra).
    replace (- y / L) with (- (y / L)) in S by (field; lra).
    rewrite round_NE_opp, Rabs_Ropp in S.
    set (q := rnd (val e / val l)) in *. set (t := rnd (cval c_scale * Rabs q)) in *.
    replace (- q + t) with (- (q + - t)) in S by ring. rewrite round_NE_opp in S. lra.
  - exfalso. assert (0 <= rnd (cval c_scale * Rabs (val (e / l)%D))).
    { apply rnd_pos, Rmult_le_pos; [rewrite C; unfold u; lra|apply Rabs_pos]. }
    assert (rnd (val (e / l)%D + val (- lit c_scale * fabs (e / l))%D) <= val (e / l)%D).
    { rewrite <- (rnd_id (val (e / l)%D)) at 2 by apply val_format. apply rnd_le. lra. }
    generalize (val_lt_max (e / l)%D) (Rle_abs (val (e / l)%D)). lra.
  - left. unfold x. rewrite E. exact next_down_ninf.
Qed.

(** l == 1: nothing is to be done, for lcm is 1. *)
Lemma scale_of_one l (L : Z) : cut_to_double l (IZR L) -> finite l -> val l = 1 -> L = 1%Z.
Proof.
  intros [->|(_ & [L1 L2] & L3)] F V; [discriminate|]. rewrite V in *.
  assert (IZR L < 2) by (unfold u in *; lra). apply le_IZR in L2. apply lt_IZR in H. lia.
Qed.
