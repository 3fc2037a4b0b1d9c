(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Interval arithmetic of src/predicate/interval_filter.h: dyd_down(c) is below, dyd_up(c) above every number that
    rounds to c, subnormals and overflow included; so sums and differences are enclosed. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Plus_error Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance.
Open Scope R_scope.

(* [ORI-1] src/predicate/interval_filter.h: return c - ({} * fabs(c) *)
Definition c_down : const := (4503599627370497, -105)%Z.
(* [ORI-1] src/predicate/interval_filter.h: return c + ({} * fabs(c) *)
Definition c_up : const := (4503599627370497, -105)%Z.
(* [ORI-1] src/predicate/interval_filter.h: return c - (0x1.0000000000001p-53 * fabs(c) + {}); *)
Definition c_down_eta : const := (1, -1074)%Z.
(* [ORI-1] src/predicate/interval_filter.h: return c + (0x1.0000000000001p-53 * fabs(c) + {}); *)
Definition c_up_eta : const := (1, -1074)%Z.

(* C src/predicate/interval_filter.h dyd_down
  return c - (0x1.0000000000001p-53 * fabs(c) + 0x1p-1074);
*)
Definition down (c : double) : double := (c - (lit c_down * fabs c + lit c_down_eta))%D.
(* C src/predicate/interval_filter.h dyd_up
  return c + (0x1.0000000000001p-53 * fabs(c) + 0x1p-1074);
*)
Definition up (c : double) : double := (c + (lit c_up * fabs c + lit c_up_eta))%D.

(** ** The step is more than half a unit in the last place *)

Definition step (c : R) : R := rnd (rnd (cval c_down * Rabs c) + cval c_down_eta).

Lemma step_more c : format c -> ulp radix2 fexp c < 2 * step c.
Proof.
  intros Fc. unfold step. set (K := cval c_down).
  assert (Eta : cval c_down_eta = bpow radix2 (-1074)) by (unfold c_down_eta, cval, fst, snd; ring). rewrite Eta.
  assert (F0 : format (bpow radix2 (-1074))) by (apply generic_format_bpow; unfold FLT_exp; lia).
  assert (PK : 0 <= K * Rabs c).
  { apply Rmult_le_pos; [|apply Rabs_pos]. unfold K, c_down; numerals; lra. }
  generalize (bpow_gt_0 radix2 (-1074)); intros B.
  destruct (Rlt_or_le (Rabs c) (bpow radix2 (-1074 + 53))) as [S|S].
  - rewrite ulp_FLT_small by (exact S || reflexivity).
    assert (bpow radix2 (-1074) <= rnd (rnd (K * Rabs c) + bpow radix2 (-1074))).
    { rewrite <- (rnd_id (bpow radix2 (-1074))) at 1 by exact F0. apply rnd_le. generalize (rnd_pos _ PK). lra. }
    lra.
  - assert (C0 : c <> 0) by (intros ->; rewrite Rabs_R0 in S; generalize (bpow_gt_0 radix2 (-1074 + 53)); lra).
    rewrite ulp_neq_0 by exact C0. unfold cexp. destruct (mag radix2 c) as [e He]; cbn [mag_val]. specialize (He C0).
    assert (E : (-1074 + 53 < e)%Z) by (apply (lt_bpow radix2); lra).
    replace (FLT_exp (-1074) 53 e) with (e - 53)%Z by (unfold FLT_exp; lia).
    assert (Q : K * bpow radix2 (e - 1) = F2R (Float radix2 4503599627370497 (e - 1 - 105))).
    { unfold K, c_down, cval, F2R, Fnum, Fexp, fst, snd. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia. }
    assert (H : bpow radix2 (e - 53) = 2 * bpow radix2 (e - 54)).
    { replace (e - 53)%Z with (1 + (e - 54))%Z by lia. rewrite bpow_plus. reflexivity. }
    rewrite H. apply Rmult_lt_compat_l; [lra|].
    destruct (Z_le_gt_dec (-968) (e - 1)) as [L|L].
    + assert (FQ : format (K * bpow radix2 (e - 1))).
      { rewrite Q. apply generic_format_FLT. eexists; [reflexivity|simpl; lia|simpl; lia]. }
      apply Rlt_le_trans with (K * bpow radix2 (e - 1)).
      { replace (e - 54)%Z with (-53 + (e - 1))%Z by lia. rewrite bpow_plus. apply Rmult_lt_compat_r;
        [apply bpow_gt_0|].
        unfold K, c_down; numerals; lra. }
      assert (K1 : K * bpow radix2 (e - 1) <= rnd (K * Rabs c)).
      { rewrite <- (rnd_id (K * bpow radix2 (e - 1))) by exact FQ. apply rnd_le.
        apply Rmult_le_compat_l; [unfold K, c_down; numerals; lra|apply He]. }
      apply Rle_trans with (rnd (K * bpow radix2 (e - 1))); [right; symmetry; now apply rnd_id|].
      apply rnd_le. apply Rle_trans with (1 := K1). clear - B. lra.
    + assert (F1 : format (bpow radix2 (e - 54))) by (apply generic_format_bpow; unfold FLT_exp; lia).
      assert (K1 : bpow radix2 (e - 54) <= rnd (K * Rabs c)).
      { rewrite <- (rnd_id (bpow radix2 (e - 54))) by exact F1. apply rnd_le.
        apply Rle_trans with (K * bpow radix2 (e - 1)); [|apply Rmult_le_compat_l; [unfold K, c_down; numerals;
          lra|apply He]].
        replace (e - 54)%Z with (-53 + (e - 1))%Z by lia. rewrite bpow_plus. apply Rmult_le_compat_r;
          [apply bpow_ge_0|].
        unfold K, c_down; numerals; lra. }
      apply Rlt_le_trans with (bpow radix2 (e - 54) + bpow radix2 (-1074)); [lra|].
      rewrite <- (rnd_id (bpow radix2 (e - 54) + bpow radix2 (-1074))).
      * apply rnd_le. lra.
      * apply (FLT_format_plus_small radix2 (-1074) 53); try assumption.
        rewrite Rabs_pos_eq by (generalize (bpow_gt_0 radix2 (e - 54)); lra).
        assert (bpow radix2 (e - 54) <= bpow radix2 (-1022)) by (apply bpow_le; lia).
        assert (bpow radix2 (-1074) <= bpow radix2 (-1022)) by (apply bpow_le; lia).
        replace (53 + -1074)%Z with (1 + -1022)%Z by lia. rewrite bpow_plus. change (bpow radix2 1) with 2. lra.
Qed.

Lemma pred_above c : format c -> c - ulp radix2 fexp c <= pred radix2 fexp c.
Proof.
  intros F. destruct (Rle_or_lt c 0) as [N|P].
  - unfold pred. rewrite succ_eq_pos by lra. rewrite ulp_opp. lra.
  - assert (P0 : 0 <= pred radix2 fexp c) by (apply pred_ge_0; [typeclasses eauto|exact P|exact F]).
    pose proof (succ_pred radix2 fexp c F) as S. rewrite succ_eq_pos in S by exact P0.
    assert (ulp radix2 fexp (pred radix2 fexp c) <= ulp radix2 fexp c) by (apply ulp_le_pos; try typeclasses eauto;
      [exact P0|apply pred_le_id]).
    lra.
Qed.

Lemma below_step c : format c -> rnd (c - step c) < c.
Proof.
  intros F. pose proof (step_more c F) as M. pose proof (pred_above c F) as A.
  assert (L : rnd (c - step c) <= pred radix2 fexp c).
  { apply round_N_le_midp; [typeclasses eauto|apply generic_format_pred; [typeclasses eauto|exact F]|].
    rewrite succ_pred by (exact F || typeclasses eauto). lra. }
  destruct (Req_dec c 0) as [Z|Z]; [|apply Rle_lt_trans with (1 := L); now apply pred_lt_id].
  subst c. apply Rle_lt_trans with (1 := L). unfold pred. rewrite Ropp_0, succ_0, ulp_FLT_small; try reflexivity.
  - generalize (bpow_gt_0 radix2 (-1074)); lra.
  - rewrite Rabs_R0. apply bpow_gt_0.
Qed.

(** What rounds to c or more is above the number below c. *)
Theorem down_below f x : finite (down f) -> val f <= rnd x -> val (down f) <= x.
Proof.
  intros F E. unfold down in *. destruct (fsub_inv _ _ F) as (Ff & F1 & V). destruct (fadd_inv _ _ F1) as (F2 & _ & V1).
  destruct (fmul_inv _ _ F2) as (_ & _ & V2). rewrite fabs_val in V2. rewrite V2 in V1. lits V1. rewrite V1 in V.
  fold (step (val f)) in V. rewrite V.
  pose proof (below_step (val f) (val_format f)) as L.
  destruct (Rle_or_lt (rnd (val f - step (val f))) x) as [K|K]; [exact K|exfalso].
  apply Rlt_le, rnd_le in K. rewrite (rnd_id (rnd _)) in K by apply rnd_format. lra.
Qed.

Theorem up_above f x : finite (up f) -> rnd x <= val f -> x <= val (up f).
Proof.
  intros F E. unfold up in *. destruct (fadd_inv _ _ F) as (Ff & F1 & V). destruct (fadd_inv _ _ F1) as (F2 & _ & V1).
  destruct (fmul_inv _ _ F2) as (_ & _ & V2). rewrite fabs_val in V2. rewrite V2 in V1. lits V1. rewrite V1 in V.
  change (cval c_up) with (cval c_down) in V. change (cval c_up_eta) with (cval c_down_eta) in V.
  fold (step (val f)) in V. rewrite V.
  pose proof (below_step (- val f) (format_opp _ (val_format f))) as L.
  replace (step (- val f)) with (step (val f)) in L by (unfold step; now rewrite Rabs_Ropp).
  replace (- val f - step (val f)) with (- (val f + step (val f))) in L by ring. rewrite round_NE_opp in L.
  destruct (Rle_or_lt x (rnd (val f + step (val f)))) as [K|K]; [exact K|exfalso].
  apply Rlt_le, rnd_le in K. rewrite (rnd_id (rnd _)) in K by apply rnd_format. lra.
Qed.

(** ** Intervals: each end is a bound of its own, or NaN, or infinite on its own side *)

Record iv := { lo : double; hi : double }.
Definition below (f : double) (x : R) : Prop := f <> inf /\ (finite f -> val f <= x).
Definition above (f : double) (x : R) : Prop := f <> ninf /\ (finite f -> x <= val f).
Definition contains (a : iv) (x : R) : Prop := below (lo a) x /\ above (hi a) x.

Section Special.
Local Transparent fadd fsub fmul fopp fabs lit.
Lemma nan_sub x y : is_nan 53 1024 x = true -> (x - y)%D <> inf.
Proof. destruct x; try discriminate; destruct y; discriminate. Qed.
Lemma sub_nan x y : is_nan 53 1024 y = true -> (x - y)%D <> inf.
Proof. destruct y; try discriminate; destruct x; discriminate. Qed.
Lemma nan_add x y : is_nan 53 1024 x = true -> (x + y)%D <> ninf.
Proof. destruct x; try discriminate; destruct y; discriminate. Qed.
Lemma add_nan x y : is_nan 53 1024 y = true -> (x + y)%D <> ninf.
Proof. destruct y; try discriminate; destruct x; discriminate. Qed.
Lemma sub_pinf x : (x - inf)%D <> inf.
Proof. destruct x as [|[|]| |]; discriminate. Qed.
Lemma add_pinf x : (x + inf)%D <> ninf.
Proof. destruct x as [|[|]| |]; discriminate. Qed.
Lemma ninf_sub_any y : (ninf - y)%D <> inf.
Proof. destruct y as [|[|]| |]; discriminate. Qed.
Lemma inf_add_any y : (inf + y)%D <> ninf.
Proof. destruct y as [|[|]| |]; discriminate. Qed.
Lemma step_inf : (lit c_down * fabs inf + lit c_down_eta)%D = inf.
Proof. vm_compute. reflexivity. Qed.
Lemma step_ninf : (lit c_up * fabs ninf + lit c_up_eta)%D = inf.
Proof. vm_compute. reflexivity. Qed.
End Special.

Lemma cases f : finite f \/ is_nan 53 1024 f = true \/ f = inf \/ f = ninf.
Proof. destruct f as [|[|]| |]; simpl; tauto. Qed.

Lemma down_not_inf f : down f <> inf.
Proof.
  unfold down. set (s := (lit c_down * fabs f + lit c_down_eta)%D).
  assert (N : nneg s) by (apply nneg_add; [apply nneg_mul; [apply nneg_lit; [reflexivity|simpl;
    lia]|apply nneg_abs]|apply nneg_lit; [reflexivity|simpl; lia]]).
  destruct (cases f) as [F|[F|[F|F]]].
  - destruct (cases s) as [S|[S|[S|S]]].
    + intros E. destruct (fsub_total f s F S) as [[G _]|[[_ A]|[E' _]]]; [rewrite E in G;
      discriminate| |rewrite E in E'; discriminate].
      assert (rnd (val f - val s) <= val f).
      { rewrite <- (rnd_id (val f)) at 2 by apply val_format. apply rnd_le. generalize (nneg_val _ N). lra. }
      generalize (val_lt_max f) (Rle_abs (val f)). lra.
    + now apply sub_nan.
    + rewrite S. apply sub_pinf.
    + rewrite S in N. discriminate.
  - now apply nan_sub.
  - unfold s. rewrite F, step_inf. apply sub_pinf.
  - rewrite F. apply ninf_sub_any.
Qed.

Lemma up_not_ninf f : up f <> ninf.
Proof.
  unfold up. set (s := (lit c_up * fabs f + lit c_up_eta)%D).
  assert (N : nneg s) by (apply nneg_add; [apply nneg_mul; [apply nneg_lit; [reflexivity|simpl;
    lia]|apply nneg_abs]|apply nneg_lit; [reflexivity|simpl; lia]]).
  destruct (cases f) as [F|[F|[F|F]]].
  - destruct (cases s) as [S|[S|[S|S]]].
    + intros E. destruct (fadd_total f s F S) as [[G _]|[[E' _]|[_ A]]]; [rewrite E in G;
      discriminate|rewrite E in E'; discriminate|].
      assert (val f <= rnd (val f + val s)).
      { rewrite <- (rnd_id (val f)) at 1 by apply val_format. apply rnd_le. generalize (nneg_val _ N). lra. }
      generalize (val_lt_max f) (Rle_abs (- val f)). rewrite Rabs_Ropp. lra.
    + now apply add_nan.
    + rewrite S. apply add_pinf.
    + rewrite S in N. discriminate.
  - now apply nan_add.
  - rewrite F. apply inf_add_any.
  - unfold s. rewrite F, step_ninf. apply add_pinf.
Qed.

Lemma down_finite f : finite (down f) -> finite f.
Proof. intros F. exact (proj1 (fsub_inv _ _ F)). Qed.
Lemma up_finite f : finite (up f) -> finite f.
Proof. intros F. exact (proj1 (fadd_inv _ _ F)). Qed.

(* C src/predicate/interval_filter.h dyd_iv_add
  return (dyd_iv){dyd_down(a.lo + b.lo), dyd_up(a.hi + b.hi)};
*)
Definition iv_add (a b : iv) : iv := {| lo := down (lo a + lo b); hi := up (hi a + hi b) |}.
(* C src/predicate/interval_filter.h dyd_iv_sub
  return (dyd_iv){dyd_down(a.lo - b.hi), dyd_up(a.hi - b.lo)};
*)
Definition iv_sub (a b : iv) : iv := {| lo := down (lo a - hi b); hi := up (hi a - lo b) |}.

Theorem iv_add_contains a b x y : contains a x -> contains b y -> contains (iv_add a b) (x + y).
Proof.
  intros [[_ A1] [_ A2]] [[_ B1] [_ B2]]. split; (split; [apply down_not_inf || apply up_not_ninf|]); simpl; intros F.
  - destruct (fadd_inv _ _ (down_finite _ F)) as (F1 & F2 & E). apply down_below; [exact F|]. rewrite E. apply rnd_le.
    specialize (A1 F1). specialize (B1 F2). lra.
  - destruct (fadd_inv _ _ (up_finite _ F)) as (F1 & F2 & E). apply up_above; [exact F|]. rewrite E. apply rnd_le.
    specialize (A2 F1). specialize (B2 F2). lra.
Qed.

Theorem iv_sub_contains a b x y : contains a x -> contains b y -> contains (iv_sub a b) (x - y).
Proof.
  intros [[_ A1] [_ A2]] [[_ B1] [_ B2]]. split; (split; [apply down_not_inf || apply up_not_ninf|]); simpl; intros F.
  - destruct (fsub_inv _ _ (down_finite _ F)) as (F1 & F2 & E). apply down_below; [exact F|]. rewrite E. apply rnd_le.
    specialize (A1 F1). specialize (B2 F2). lra.
  - destruct (fsub_inv _ _ (up_finite _ F)) as (F1 & F2 & E). apply up_above; [exact F|]. rewrite E. apply rnd_le.
    specialize (A2 F1). specialize (B1 F2). lra.
Qed.
