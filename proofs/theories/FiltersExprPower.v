(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-EXPR] Powers by squaring. *)
From Coq Require Import Bool ZArith NArith Nnat Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersInterval FiltersIntervalSign
  FiltersExpr.
Open Scope R_scope.

Definition is_good (a : iv) : bool := is_finite 53 1024 (lo a) && is_finite 53 1024 (hi a).
Lemma is_good_good a : is_good a = true <-> good a.
Proof. unfold is_good, good. rewrite andb_true_iff. reflexivity. Qed.

(* C src/stream/expr_filter.c glance_power
  dyd_double_span result = {1, 1};
  const dyd_double_span nothing = {NAN, NAN};
  if (n < 0) {
    a = glance_power(a, -n);
    return glance_is_good(a) ? glance_divide(result, a) : nothing;
  }
  if (n % 2 == 0) a = glance_absolute(a);
  for (; n; n /= 2) {
    if (n % 2) result = glance_multiply(result, a);
    a = glance_multiply(a, a);
    if (!glance_is_good(a) && n > 1) return nothing;
  }
  return result;
*)
Fixpoint power_loop (n : positive) (result a : iv) : iv :=
  match n with
  | xH => span_mul result a
  | xO m => let a := span_mul a a in if is_good a then power_loop m result a else unknown
  | xI m => let result := span_mul result a in let a := span_mul a a in
            if is_good a then power_loop m result a else unknown
  end.
Definition span_one : iv := {| lo := lit c_one; hi := lit c_one |}.
Definition span_power (a : iv) (n : N) : iv :=
  match n with
  | N0 => span_one
  | Npos p => power_loop p span_one (if N.even n then span_abs a else a)
  end.
(** With exponents of either sign. *)
Definition span_power_signed (a : iv) (n : Z) : iv :=
  if (n <? 0)%Z then
    let b := span_power a (Z.to_N (- n)) in if is_good b then span_div span_one b else unknown
  else span_power a (Z.to_N n).

Lemma unknown_not_good : ~ good unknown.
Proof. intros [F _]. cbn [lo unknown] in F. pose proof nan_is_nan. destruct nan; discriminate. Qed.

(** Ends that are on no wrong side. *)
Definition sane (a : iv) : Prop := lo a <> inf /\ hi a <> ninf.
Lemma pred_not_inf f : b64_pred f <> inf.
Proof.
  intros E. destruct (cases f) as [F|[F|[F|F]]].
  - destruct (FiltersScale.next_down f F) as [G|[G _]]; [congruence|]. rewrite E in G. discriminate.
  - destruct f; try discriminate.
  - rewrite F in E. discriminate.
  - rewrite F in E. discriminate.
Qed.
Lemma succ_not_ninf f : b64_succ f <> ninf.
Proof.
  intros E. destruct (cases f) as [F|[F|[F|F]]].
  - destruct (FiltersScale.next_up f F) as [G|[G _]]; [congruence|]. rewrite E in G. discriminate.
  - destruct f; try discriminate.
  - rewrite F in E. discriminate.
  - rewrite F in E. discriminate.
Qed.
Lemma unknown_sane : sane unknown.
Proof. pose proof nan_is_nan. split; cbn [lo hi unknown]; intros E; rewrite E in H; discriminate. Qed.
Lemma span_mul_sane a b : sane (span_mul a b).
Proof.
  unfold span_mul. destruct (_ && _); [split; [apply pred_not_inf|apply succ_not_ninf]|].
  unfold corners. destruct (is_nan 53 1024 _); [apply unknown_sane|split; [apply pred_not_inf|apply succ_not_ninf]].
Qed.

Section Infinite.
Local Transparent fmul.
Lemma inf_mul_nneg y : finite y -> 0 <= val y -> (inf * y)%D = inf \/ is_nan 53 1024 (inf * y)%D = true.
Proof.
  intros F P. destruct y as [s|s|s q Hq|[|] m e He]; try discriminate.
  - right. reflexivity.
  - exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in P. lra.
  - left. reflexivity.
Qed.
End Infinite.

(** An interval that is not good stays so. *)
Lemma span_mul_good r a x : sane r -> holds a x -> good (span_mul r a) -> good r.
Proof.
  intros [S1 S2] (A0 & A1 & A2 & A3). destruct zero_lit as [Fz Vz]. unfold span_mul.
  destruct (le (lit c_zero) (lo r) && le (lit c_zero) (lo a)) eqn:C.
  - intros [F G]. cbn [lo hi] in *. apply andb_prop in C. destruct C as [Cr Ca].
    apply le_finite in Ca; [|assumption..]. rewrite Vz in Ca. split.
    + destruct (cases (lo r)) as [K|[K|[K|K]]]; [exact K|exfalso..].
      * destruct (lo r); try discriminate; destruct (lit c_zero); discriminate.
      * contradiction.
      * rewrite K in Cr. destruct (lit c_zero); try discriminate.
    + destruct (cases (hi r)) as [K|[K|[K|K]]]; [exact K|exfalso..].
      * assert (N : is_nan 53 1024 (hi r * hi a)%D = true).
        { apply nan_mul. exact K. }
        rewrite (succ_nan _ N) in G. discriminate.
      * rewrite K in G. destruct (inf_mul_nneg (hi a) A1 ltac:(lra)) as [E|E].
        -- rewrite E in G. discriminate.
        -- rewrite (succ_nan _ E) in G. discriminate.
      * contradiction.
  - intros G. destruct (corners_finite _ _ _ _ G) as (P & _ & _ & S).
    destruct (fmul_inv _ _ P) as (P1 & _ & _). destruct (fmul_inv _ _ S) as (P2 & _ & _). now split.
Qed.

Lemma power_loop_holds n : forall result a r x, sane result -> (good result -> holds result r) -> holds a x ->
  good (power_loop n result a) -> holds (power_loop n result a) (r * x ^ Pos.to_nat n).
Proof.
  induction n as [n IH|n IH|]; intros result a r x S R A G; cbn [power_loop] in *; cbv zeta in *.
  - destruct (is_good (span_mul a a)) eqn:K; [|exfalso; now apply unknown_not_good]. apply is_good_good in K.
    replace (r * x ^ Pos.to_nat (xI n)) with (r * x * (x * x) ^ Pos.to_nat n).
    + apply IH; [apply span_mul_sane| |now apply span_mul_holds|exact G].
      intros H. apply span_mul_holds; [|exact A|exact H]. apply R. now apply (span_mul_good result a x).
    + rewrite Pos2Nat.inj_xI, Rpow_mult_distr. cbn [pow]. rewrite pow_mult. cbn [pow]. rewrite Rmult_1_r, Rpow_mult_distr.
      ring.
  - destruct (is_good (span_mul a a)) eqn:K; [|exfalso; now apply unknown_not_good]. apply is_good_good in K.
    replace (r * x ^ Pos.to_nat (xO n)) with (r * (x * x) ^ Pos.to_nat n).
    + apply IH; [exact S|exact R|now apply span_mul_holds|exact G].
    + rewrite Pos2Nat.inj_xO, pow_mult. cbn [pow]. now rewrite Rmult_1_r.
  - change (Pos.to_nat 1) with 1%nat. rewrite pow_1. apply span_mul_holds; [|exact A|exact G].
    apply R. now apply (span_mul_good result a x).
Qed.

Lemma even_power x n : N.even n = true -> Rabs x ^ N.to_nat n = x ^ N.to_nat n.
Proof.
  intros E. apply N.even_spec in E. destruct E as [k ->]. rewrite N2Nat.inj_mul. change (N.to_nat 2) with 2%nat.
  rewrite !pow_mult. f_equal. cbn [pow]. rewrite !Rmult_1_r, <- Rabs_mult. apply Rabs_pos_eq, Rle_0_sqr.
Qed.

Lemma span_one_holds : holds span_one 1.
Proof.
  destruct (lit_correct c_one eq_refl) as [F V]. split; [exact F|]. split; [exact F|]. cbn [lo hi span_one]. rewrite V.
  unfold c_one, cval; cbn [fst snd bpow]. lra.
Qed.

Theorem span_power_holds a x n : holds a x -> good (span_power a n) -> holds (span_power a n) (x ^ N.to_nat n).
Proof.
  intros A. pose proof span_one_holds as One.
  destruct n as [|p]; [intros _; exact One|]. cbn [span_power]. intros G.
  assert (S : sane span_one).
  { destruct One as (F & _). split; cbn [lo hi span_one] in *; intros E; rewrite E in F; discriminate. }
  destruct (N.even (Npos p)) eqn:E.
  - rewrite <- (even_power x _ E). change (N.to_nat (Npos p)) with (Pos.to_nat p). rewrite <- (Rmult_1_l (_ ^ _)).
    apply power_loop_holds; [exact S|now intros _|now apply span_abs_holds|exact G].
  - change (N.to_nat (Npos p)) with (Pos.to_nat p). rewrite <- (Rmult_1_l (_ ^ _)).
    now apply power_loop_holds.
Qed.

(** Defined, and between the ends. *)
Theorem span_power_signed_holds a x n : holds a x -> good (span_power_signed a n) ->
  if (n <? 0)%Z then x ^ Z.to_nat (- n) <> 0 /\ holds (span_power_signed a n) (/ x ^ Z.to_nat (- n))
  else holds (span_power_signed a n) (x ^ Z.to_nat n).
Proof.
  intros A. unfold span_power_signed. cbv zeta. destruct (n <? 0)%Z; rewrite <- Z_N_nat.
  - destruct (is_good _) eqn:K; [|intros G; exfalso; now apply unknown_not_good]. apply is_good_good in K. intros G.
    destruct (span_div_holds _ _ _ _ span_one_holds (span_power_holds a x _ A K) G) as [N H]. split; [exact N|].
    unfold Rdiv in H. now rewrite Rmult_1_l in H.
  - intros G. now apply span_power_holds.
Qed.
