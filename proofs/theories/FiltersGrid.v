(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-GRID] Rounding outward to multiples of 2^-k in doubles: nothing is rounded but by floor and ceil. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersInterval.
Open Scope R_scope.

(** ** The C code *)

(* [FLT-GRID] src/stream/span_filter.c: if (!(width <= {})) return INT64_MIN; *)
Definition c_grid_wide : const := (1, -1)%Z.
(* [FLT-GRID] src/stream/span_filter.c: floor(lo) * down + {}, *)
(* [FLT-GRID] src/stream/span_filter.c: ceil(hi) * down + {}}; *)
Definition c_grid_zero : const := (0, 0)%Z.
(* [FLT-GRID] src/stream/span_filter.c: #define MOST_BITS {} *)
Notation z_grid_most := 1000%Z.
Notation int64_max := (2 ^ 63 - 1)%Z.
Notation int64_min := (- 2 ^ 63)%Z.
(* C src/stream/span_filter.c dyd_filter_bits
  double width = a.hi - a.lo;
  if (width == 0) return INT64_MAX;
  if (!(width <= 0.5)) return INT64_MIN;
  uint64_t pattern = dyd_pattern_of(width);
  int64_t e = (int64_t)(pattern >> 52) - 1023 + (pattern << 12 != 0);
  return -e - 1 < MOST_BITS ? -e - 1 : MOST_BITS;
*)
Definition filter_bits (a : iv) : Z :=
  let width := (hi a - lo a)%D in
  if le width (lit c_zero) && le (lit c_zero) width then int64_max
  else if negb (le width (lit c_grid_wide)) then int64_min
  else
    let pattern := bits_of_b64 width in
    let e := (pattern / 2 ^ 52 - 1023 + (if pattern mod 2 ^ 52 =? 0 then 0 else 1))%Z in
    if (- e - 1 <? z_grid_most)%Z then (- e - 1)%Z else z_grid_most.
(* C src/stream/span_filter.c power_of_two
  return dyd_double_of_pattern((uint64_t)(k + 1023) << 52);
*)
Definition power_of_two (k : Z) : double := lit (1%Z, k).
Definition ffloor : double -> double := Bnearbyint 53 1024 (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_DN.
Definition fceil : double -> double := Bnearbyint 53 1024 (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_UP.
(* C src/stream/span_filter.c dyd_filter_round
  int64_t most = dyd_filter_bits(a);
  if (bits > most || bits < 0) return false;
  *out = a;
  if (most == INT64_MAX) return true;
  if (bits > MOST_BITS) return false;
  double up = power_of_two(bits + 2), down = power_of_two(-bits - 2), lo = a.lo * up, hi = a.hi * up;
  if (isfinite(lo) && isfinite(hi)) *out = (dyd_double_span){floor(lo) * down + 0.0, ceil(hi) * down + 0.0};
  return true;
*)
Definition filter_round (a : iv) (bits : Z) : option iv :=
  let most := filter_bits a in
  if (most <? bits)%Z || (bits <? 0)%Z then None
  else if (most =? int64_max)%Z then Some a
  else if (z_grid_most <? bits)%Z then None
  else
    let up := power_of_two (bits + 2) in let down := power_of_two (- bits - 2) in
    let l := (lo a * up)%D in let h := (hi a * up)%D in
    if is_finite 53 1024 l && is_finite 53 1024 h
    then Some {| lo := (ffloor l * down + lit c_grid_zero)%D; hi := (fceil h * down + lit c_grid_zero)%D |}
    else Some a.

(** ** Numbers that are doubles *)

Lemma format_scaled_up x k : (0 <= k)%Z -> format x -> format (x * bpow radix2 k).
Proof.
  intros K F. apply FLT_format_generic in F; [|reflexivity]. destruct F as [[m e] -> Hm He]. cbn [Fnum Fexp] in *.
  apply generic_format_FLT. exists (Float radix2 m (e + k)); cbn [Fnum Fexp]; [|exact Hm|lia].
  unfold F2R; cbn [Fnum Fexp]. rewrite bpow_plus. ring.
Qed.

Lemma format_integer n : (Z.abs n <= 2 ^ 53)%Z -> forall k, (-1074 <= k)%Z -> format (IZR n * bpow radix2 k).
Proof.
  intros H k K. destruct (Z.eq_dec (Z.abs n) (2 ^ 53)) as [E|E].
  - assert (B : format (bpow radix2 (53 + k))) by (apply generic_format_bpow; unfold FLT_exp; lia).
    assert (C : bpow radix2 (53 + k) = IZR (2 ^ 53) * bpow radix2 k) by (rewrite bpow_plus; reflexivity).
    rewrite C in B. destruct (Z.abs_spec n) as [[_ A]|[_ A]]; rewrite A in E.
    + now rewrite E.
    + replace n with (- 2 ^ 53)%Z by lia. rewrite opp_IZR, Ropp_mult_distr_l_reverse. now apply format_opp.
  - apply generic_format_FLT. exists (Float radix2 n k); cbn [Fnum Fexp]; [reflexivity|change (Z.abs n < 2 ^ 53)%Z; lia|exact K].
Qed.

(** A double of 2^53 or more is an integer. *)
Lemma large_integer z : format z -> IZR (2 ^ 53) <= Rabs z -> exists n, z = IZR n.
Proof.
  intros F H. apply FLT_format_generic in F; [|reflexivity]. destruct F as [[m e] -> Hm He]. cbn [Fnum Fexp] in *.
  destruct (Z_le_gt_dec 0 e) as [P|N].
  - exists (m * 2 ^ e)%Z. unfold F2R; cbn [Fnum Fexp]. rewrite mult_IZR. f_equal.
    rewrite <- (IZR_Zpower radix2) by exact P. reflexivity.
  - exfalso. unfold F2R in H; cbn [Fnum Fexp] in H. rewrite Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow _ _)) in H by apply
      bpow_ge_0.
    assert (bpow radix2 e <= 1) by (apply (bpow_le radix2 e 0); lia).
    assert (IZR (Z.abs m) < IZR (2 ^ 53)) by (now apply IZR_lt).
    assert (0 <= IZR (Z.abs m)) by (apply IZR_le; lia).
    assert (IZR (Z.abs m) * bpow radix2 e <= IZR (Z.abs m) * 1) by (apply Rmult_le_compat_l; assumption). lra.
Qed.

(** Floor and ceil of x 2^k, and these times 2^-k, are doubles. *)
Lemma grid_format (round_int : R -> Z) x k : (forall n, round_int (IZR n) = n) ->
  (forall z, Rabs z < IZR (2 ^ 53) -> (Z.abs (round_int z) <= 2 ^ 53)%Z) -> (0 <= k <= 1074)%Z -> format x ->
  format (IZR (round_int (x * bpow radix2 k))) /\ format (IZR (round_int (x * bpow radix2 k)) * bpow radix2 (- k)).
Proof.
  intros Id Small K F. pose proof (format_scaled_up x k ltac:(lia) F) as Fz. set (z := x * bpow radix2 k) in *.
  destruct (Rlt_or_le (Rabs z) (IZR (2 ^ 53))) as [L|L].
  - specialize (Small z L). split; [|apply format_integer; [exact Small|lia]].
    rewrite <- (Rmult_1_r (IZR _)). apply (format_integer _ Small 0). lia.
  - destruct (large_integer z Fz L) as [n E]. rewrite E, Id, <- E. split; [exact Fz|]. unfold z.
    rewrite Rmult_assoc, <- bpow_plus. replace (k + - k)%Z with 0%Z by lia. cbn [bpow]. now rewrite Rmult_1_r.
Qed.

Lemma floor_small z : Rabs z < IZR (2 ^ 53) -> (Z.abs (Zfloor z) <= 2 ^ 53)%Z.
Proof.
  intros H. apply Rabs_lt_inv in H. destruct H as [A B].
  assert ((- 2 ^ 53 <= Zfloor z)%Z) by (apply Zfloor_lub; rewrite opp_IZR; lra).
  assert ((Zfloor z <= 2 ^ 53)%Z) by (apply le_IZR; generalize (Zfloor_lb z); lra). lia.
Qed.
Lemma ceil_small z : Rabs z < IZR (2 ^ 53) -> (Z.abs (Zceil z) <= 2 ^ 53)%Z.
Proof.
  intros H. unfold Zceil. rewrite Z.abs_opp. apply floor_small. now rewrite Rabs_Ropp.
Qed.

(** ** The theorem *)

(** C: double operations; lo and hi are the doubles a.lo * up and a.hi * up, finite; f and c what floor and ceil make of
    them; 2^k is up, 2^-k is down. *)
Theorem grid_ends a_lo a_hi up down f c k : (0 <= k <= 1074)%Z -> finite up -> val up = bpow radix2 k ->
  finite down -> val down = bpow radix2 (- k) -> finite (a_lo * up)%D -> finite (a_hi * up)%D ->
  finite f -> val f = IZR (Zfloor (val (a_lo * up)%D)) -> finite c -> val c = IZR (Zceil (val (a_hi * up)%D)) ->
  finite (f * down)%D -> finite (c * down)%D ->
  val (f * down)%D = IZR (Zfloor (val a_lo * bpow radix2 k)) * bpow radix2 (- k) /\
  val (c * down)%D = IZR (Zceil (val a_hi * bpow radix2 k)) * bpow radix2 (- k) /\
  val (f * down)%D <= val a_lo /\ val a_hi <= val (c * down)%D.
Proof.
  intros K Fu Vu Fd Vd F1 F2 Ff Vf Fc Vc F3 F4.
  destruct (fmul_inv _ _ F1) as (_ & _ & E1). destruct (fmul_inv _ _ F2) as (_ & _ & E2).
  destruct (fmul_inv _ _ F3) as (_ & _ & E3). destruct (fmul_inv _ _ F4) as (_ & _ & E4).
  rewrite Vu in E1, E2. rewrite rnd_id in E1 by (apply format_scaled_up; [lia|apply val_format]).
  rewrite rnd_id in E2 by (apply format_scaled_up; [lia|apply val_format]).
  rewrite E1 in Vf. rewrite E2 in Vc. rewrite Vf, Vd in E3. rewrite Vc, Vd in E4.
  destruct (grid_format Zfloor (val a_lo) k Zfloor_IZR floor_small K (val_format _)) as [_ G1].
  destruct (grid_format Zceil (val a_hi) k Zceil_IZR ceil_small K (val_format _)) as [_ G2].
  rewrite rnd_id in E3 by exact G1. rewrite rnd_id in E4 by exact G2.
  split; [exact E3|]. split; [exact E4|]. rewrite E3, E4.
  assert (B : 0 < bpow radix2 (- k)) by apply bpow_gt_0.
  assert (back : forall x, x * bpow radix2 k * bpow radix2 (- k) = x).
  { intros x. rewrite Rmult_assoc, <- bpow_plus. replace (k + - k)%Z with 0%Z by lia. cbn [bpow]. apply Rmult_1_r. }
  split.
  - rewrite <- (back (val a_lo)) at 2. apply Rmult_le_compat_r; [lra|apply Zfloor_lb].
  - rewrite <- (back (val a_hi)) at 1. apply Rmult_le_compat_r; [lra|apply Zceil_ub].
Qed.

(** A computed width of at most 2^-(bits+1) becomes at most 2^-bits; k = bits + 2. *)
Theorem grid_width a_lo a_hi k : (2 <= k <= 1002)%Z -> val a_lo <= val a_hi -> finite (a_hi - a_lo)%D ->
  val (a_hi - a_lo)%D <= bpow radix2 (1 - k) ->
  IZR (Zceil (val a_hi * bpow radix2 k)) * bpow radix2 (- k) - IZR (Zfloor (val a_lo * bpow radix2 k)) * bpow radix2 (- k)
    <= bpow radix2 (2 - k).
Proof.
  intros K L F W. destruct (fsub_inv _ _ F) as (_ & _ & E). rewrite E in W. clear F E.
  pose proof (rnd_add_lower (val a_hi) (- val a_lo) (val_format _) (format_opp _ (val_format _)) ltac:(lra)) as R.
  replace (val a_hi + - val a_lo) with (val a_hi - val a_lo) in R by ring.
  set (h := val a_hi) in *. set (l := val a_lo) in *. set (b := bpow radix2 k).
  assert (B : 0 < b) by apply bpow_gt_0.
  assert (Q : bpow radix2 (- k) * b = 1) by (unfold b; rewrite <- bpow_plus; replace (- k + k)%Z with 0%Z by lia; reflexivity).
  assert (P : 0 < bpow radix2 (- k)) by apply bpow_gt_0.
  assert (W' : bpow radix2 (1 - k) = 2 * bpow radix2 (- k)) by (unfold Z.sub; rewrite bpow_plus; reflexivity).
  assert (W4 : bpow radix2 (2 - k) = 4 * bpow radix2 (- k)) by (unfold Z.sub; rewrite bpow_plus; reflexivity).
  rewrite W' in W. rewrite W4.
  assert (D : h - l <= 2 * bpow radix2 (- k) * (1 + / 4)) by (unfold u in R; lra).
  assert (D' : h * b - l * b <= 5 / 2).
  { replace (h * b - l * b) with ((h - l) * b) by ring.
    apply Rle_trans with (2 * bpow radix2 (- k) * (1 + / 4) * b); [apply Rmult_le_compat_r; lra|].
    replace (2 * bpow radix2 (- k) * (1 + / 4) * b) with (5 / 2 * (bpow radix2 (- k) * b)) by field. rewrite Q. lra. }
  assert (U : (Zceil (h * b) - Zfloor (l * b) < 5)%Z).
  { apply lt_IZR. rewrite minus_IZR. pose proof (Zfloor_ub (l * b)).
    assert (IZR (Zceil (h * b)) < h * b + 1).
    { unfold Zceil. rewrite opp_IZR. pose proof (Zfloor_ub (- (h * b))). lra. }
    lra. }
  assert (V : IZR (Zceil (h * b)) - IZR (Zfloor (l * b)) <= 4) by (rewrite <- minus_IZR; apply IZR_le; lia).
  rewrite <- Rmult_minus_distr_r. apply Rmult_le_compat_r; lra.
Qed.

(** ** The program that is run *)

Section Power.
Local Transparent lit.
Lemma power_of_two_correct k : (-1074 <= k <= 1023)%Z -> finite (power_of_two k) /\ val (power_of_two k) = bpow radix2 k.
Proof.
  intros K. unfold power_of_two, lit. cbn [fst snd].
  assert (E : F2R (Float radix2 1 k) = bpow radix2 k) by (unfold F2R; cbn [Fnum Fexp]; ring).
  generalize (binary_normalize_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) mode_NE 1 k false).
  rewrite E. change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  rewrite round_generic; [|apply valid_rnd_N|apply generic_format_bpow; unfold FLT_exp; lia].
  rewrite Rlt_bool_true; [intros (A & B & _); now split|].
  rewrite Rabs_pos_eq by apply bpow_ge_0. apply bpow_lt. lia.
Qed.
End Power.

Lemma ffloor_correct x : is_finite 53 1024 (ffloor x) = is_finite 53 1024 x /\ val (ffloor x) = IZR (Zfloor (val x)).
Proof.
  destruct (Bnearbyint_correct 53 1024 (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_DN x) as (V & F & _).
  split; [exact F|]. unfold ffloor. rewrite V. unfold round, scaled_mantissa, cexp, FIX_exp, F2R. cbn [Fnum Fexp bpow Z.opp].
  now rewrite !Rmult_1_r.
Qed.
Lemma fceil_correct x : is_finite 53 1024 (fceil x) = is_finite 53 1024 x /\ val (fceil x) = IZR (Zceil (val x)).
Proof.
  destruct (Bnearbyint_correct 53 1024 (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_UP x) as (V & F & _).
  split; [exact F|]. unfold fceil. rewrite V. unfold round, scaled_mantissa, cexp, FIX_exp, F2R. cbn [Fnum Fexp bpow Z.opp].
  now rewrite !Rmult_1_r.
Qed.

(** The exponent in the pattern of a double, one more unless the rest of the pattern is 0. *)
Lemma pattern_above x : finite x -> 0 < val x ->
  val x <= bpow radix2 (bits_of_b64 x / 2 ^ 52 - 1023 + (if bits_of_b64 x mod 2 ^ 52 =? 0 then 0 else 1))%Z.
Proof.
  destruct x as [s|s|s p Hp|[|] m e H]; try discriminate; intros _ P.
  { simpl in P. lra. }
  { exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in P. lra. }
  clear P. change (val (B754_finite 53 1024 false m e H)) with (F2R (Float radix2 (Zpos m) e)).
  pose proof H as B. unfold SpecFloat.bounded in B. apply andb_prop in B. destruct B as [C _]. unfold SpecFloat.canonical_mantissa in C.
  apply Zeq_bool_eq in C. unfold SpecFloat.fexp, SpecFloat.emin in C. rewrite Zpos_digits2_pos in C.
  pose proof (Zdigits_correct radix2 (Zpos m)) as [D0 D1]. change (radix_val radix2) with 2%Z in *. cbn [Z.abs] in D0, D1.
  set (d := Zdigits radix2 (Zpos m)) in *.
  assert (M : (Zpos m < 2 ^ 53)%Z) by (apply Z.lt_le_trans with (1 := D1); apply Z.pow_le_mono_r; lia).
  assert (val_le : forall k : Z, (0 <= k)%Z -> (Zpos m <= 2 ^ k)%Z -> F2R (Float radix2 (Zpos m) e) <= bpow radix2 (k + e)).
  { intros k K L. unfold F2R. cbn [Fnum Fexp]. rewrite bpow_plus. apply Rmult_le_compat_r; [apply bpow_ge_0|].
    rewrite <- (IZR_Zpower radix2) by exact K. now apply IZR_le. }
  unfold bits_of_b64, bits_of_binary_float. destruct (Zle_bool 0 (Zpos m - 2 ^ 52)) eqn:L.
  - apply Zle_bool_imp_le in L. unfold join_bits. rewrite Z.shiftl_mul_pow2 by lia.
    change (SpecFloat.emin (52 + 1) (2 ^ (11 - 1))) with (-1074)%Z.
    replace ((0 + (e - -1074 + 1)) * 2 ^ 52 + (Zpos m - 2 ^ 52))%Z with (Zpos m - 2 ^ 52 + (e + 1075) * 2 ^ 52)%Z by ring.
    rewrite Z.div_add, Z.mod_add by lia. rewrite Z.div_small, Z.mod_small by lia.
    destruct (Z.eqb_spec (Zpos m - 2 ^ 52) 0) as [E|E].
    + replace (0 + (e + 1075) - 1023 + 0)%Z with (52 + e)%Z by lia. apply val_le; lia.
    + replace (0 + (e + 1075) - 1023 + 1)%Z with (53 + e)%Z by lia. apply val_le; lia.
  - assert (S : (Zpos m < 2 ^ 52)%Z) by (apply Z.leb_gt in L; lia). unfold join_bits. cbn [Z.add]. rewrite Z.shiftl_0_l, Z.add_0_l.
    rewrite Z.div_small, Z.mod_small by lia. replace (Zpos m =? 0)%Z with false by reflexivity.
    assert (d - 1 < 52)%Z by (apply (Z.pow_lt_mono_r_iff 2); lia).
    replace (0 - 1023 + 1)%Z with (52 + e)%Z by lia. apply val_le; lia.
Qed.

Lemma filter_bits_zero a : filter_bits a = int64_max -> finite (hi a - lo a)%D /\ val (hi a - lo a)%D = 0.
Proof.
  destruct zero_lit as [Fz Vz]. unfold filter_bits. cbv zeta. destruct (le _ (lit c_zero) && le (lit c_zero) _) eqn:E.
  - intros _. apply andb_prop in E. destruct E as [E1 E2]. assert (F : finite (hi a - lo a)%D).
    { revert E1 E2. generalize (hi a - lo a)%D. intros w. destruct w as [s|[|]|s p Hp|s m e H]; try reflexivity;
        destruct (lit c_zero) as [t|t|t q Hq|t n f K]; try discriminate. }
    split; [exact F|]. apply le_finite in E1; [|assumption..]. apply le_finite in E2; [|assumption..]. lra.
  - destruct (negb _); [discriminate|]. destruct (Z.ltb_spec (- (bits_of_b64 (hi a - lo a)%D / 2 ^ 52 - 1023 +
      (if bits_of_b64 (hi a - lo a)%D mod 2 ^ 52 =? 0 then 0 else 1)) - 1)%Z z_grid_most); intros H0; lia.
Qed.

(** What dyd_filter_bits finds holds of the computed width. *)
Lemma filter_bits_narrow a bits : (0 <= bits <= filter_bits a)%Z -> filter_bits a <> int64_max ->
  val (lo a) <= val (hi a) -> finite (hi a - lo a)%D /\ val (hi a - lo a)%D <= bpow radix2 (- bits - 1).
Proof.
  destruct zero_lit as [Fz Vz]. destruct (lit_correct c_grid_wide eq_refl) as [Fw _].
  intros B N L. revert B N. unfold filter_bits. cbv zeta. set (w := (hi a - lo a)%D).
  destruct (le w (lit c_zero) && le (lit c_zero) w) eqn:E; [intros _ N; now contradiction N|].
  destruct (le w (lit c_grid_wide)) eqn:W; cbn [negb]; [|intros B; lia]. intros B _.
  set (e := (bits_of_b64 w / 2 ^ 52 - 1023 + (if bits_of_b64 w mod 2 ^ 52 =? 0 then 0 else 1))%Z) in *.
  assert (F : finite w).
  { destruct (cases w) as [F|[F|[F|F]]]; [exact F|exfalso..].
    - destruct w; try discriminate F. destruct (lit c_grid_wide); discriminate W.
    - rewrite F in W. destruct (lit c_grid_wide); discriminate.
    - revert B. unfold e. rewrite F. change (bits_of_b64 ninf) with 18442240474082181120%Z.
      change (18442240474082181120 / 2 ^ 52)%Z with 4095%Z. change (18442240474082181120 mod 2 ^ 52 =? 0)%Z with true.
      cbv iota. change (- (4095 - 1023 + 0) - 1 <? z_grid_most)%Z with true. cbv iota. lia. }
  split; [exact F|]. unfold w in F. destruct (fsub_inv _ _ F) as (_ & _ & V). fold w in F, V.
  assert (P : 0 <= val w) by (rewrite V; apply rnd_pos; lra).
  destruct (Rle_lt_or_eq_dec 0 (val w) P) as [Q|Q]; [|rewrite <- Q; apply bpow_ge_0].
  apply Rle_trans with (1 := pattern_above w F Q). fold e. apply bpow_le. destruct (Z.ltb_spec (- e - 1) z_grid_most); lia.
Qed.

(** Nothing overflows on the way back. *)
Lemma grid_finite (round_int : R -> Z) f down x k : (forall n, round_int (IZR n) = n) ->
  (forall z, Rabs z < IZR (2 ^ 53) -> (Z.abs (round_int z) <= 2 ^ 53)%Z) -> (0 <= k <= 1074)%Z ->
  finite f -> val f = IZR (round_int (val x * bpow radix2 k)) -> finite down -> val down = bpow radix2 (- k) ->
  finite (f * down + lit c_grid_zero)%D.
Proof.
  intros Id Small K Ff Vf Fd Vd. destruct (lit_correct c_grid_zero eq_refl) as [Fz Vz].
  assert (Z0 : cval c_grid_zero = 0) by (unfold cval, c_grid_zero; simpl; ring). rewrite Z0 in Vz.
  destruct (grid_format round_int (val x) k Id Small K (val_format _)) as [_ G].
  assert (B : Rabs (IZR (round_int (val x * bpow radix2 k)) * bpow radix2 (- k)) < bpow radix2 1024).
  { destruct (Rlt_or_le (Rabs (val x * bpow radix2 k)) (IZR (2 ^ 53))) as [L|L].
    - rewrite Rabs_mult, <- abs_IZR, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0.
      apply Rle_lt_trans with (IZR (2 ^ 53) * bpow radix2 0); [|change (IZR (2 ^ 53)) with (bpow radix2 53); rewrite <- bpow_plus;
        apply bpow_lt; lia].
      apply Rmult_le_compat; [apply IZR_le; lia|apply bpow_ge_0|apply IZR_le; now apply Small|apply bpow_le; lia].
    - destruct (large_integer _ (format_scaled_up _ k ltac:(lia) (val_format x)) L) as [n E]. rewrite E, Id, <- E, Rmult_assoc,
        <- bpow_plus. replace (k + - k)%Z with 0%Z by lia. cbn [bpow]. rewrite Rmult_1_r. apply val_lt_max. }
  destruct (fmul_finite f down Ff Fd) as [F E].
  { rewrite Vf, Vd, rnd_id by exact G. exact B. }
  rewrite Vf, Vd, rnd_id in E by exact G. apply fadd_finite; [exact F|exact Fz|].
  rewrite Vz, Rplus_0_r, rnd_id by apply val_format. apply val_lt_max.
Qed.

(** [FLT-GRID] Outward, and at most 2^-bits wide. *)
Theorem filter_round_holds a bits r : finite (lo a) -> finite (hi a) -> val (lo a) <= val (hi a) ->
  filter_round a bits = Some r -> finite (lo r) /\ finite (hi r) /\
  val (lo r) <= val (lo a) /\ val (hi a) <= val (hi r) /\ val (hi r) - val (lo r) <= bpow radix2 (- bits).
Proof.
  intros Fl Fh L S. unfold filter_round in S. cbv zeta in S.
  destruct ((filter_bits a <? bits)%Z || (bits <? 0)%Z) eqn:B; [discriminate|]. apply orb_false_iff in B.
  destruct B as [B1 B0]. apply Z.ltb_ge in B1, B0. destruct (Z.eqb_spec (filter_bits a) int64_max) as [M|M].
  { injection S as <-. destruct (filter_bits_zero a M) as [F V]. destruct (fsub_inv _ _ F) as (_ & _ & E). rewrite E in V.
    pose proof (rnd_add_lower (val (hi a)) (- val (lo a)) (val_format _) (format_opp _ (val_format _)) ltac:(lra)) as R.
    unfold Rminus in V. rewrite V in R. pose proof (bpow_ge_0 radix2 (- bits)). unfold u in R. repeat split; try assumption; lra. }
  destruct (filter_bits_narrow a bits (conj B0 B1) M L) as [Fw W]. destruct (Z.ltb_spec z_grid_most bits) as [K|K]; [discriminate|].
  assert (Wr : val (hi a) - val (lo a) <= bpow radix2 (- bits)).
  { destruct (fsub_inv _ _ Fw) as (_ & _ & E). rewrite E in W.
    pose proof (rnd_add_lower (val (hi a)) (- val (lo a)) (val_format _) (format_opp _ (val_format _)) ltac:(lra)) as R.
    unfold Rminus in *. replace (- bits + - (1))%Z with (- bits - 1)%Z in * by lia.
    assert (D : bpow radix2 (- bits) = 2 * bpow radix2 (- bits - 1)).
    { replace (- bits)%Z with (1 + (- bits - 1))%Z at 1 by lia. rewrite bpow_plus. reflexivity. }
    pose proof (bpow_ge_0 radix2 (- bits - 1)). unfold u in R. lra. }
  destruct (is_finite 53 1024 (lo a * power_of_two (bits + 2))%D && is_finite 53 1024 (hi a * power_of_two (bits + 2))%D)
    eqn:G; injection S as <-; [|repeat split; try assumption; lra]. cbn [lo hi] in *. apply andb_prop in G. destruct G as [G0 G1].
  destruct (power_of_two_correct (bits + 2) ltac:(lia)) as [Fu Vu].
  destruct (power_of_two_correct (- bits - 2) ltac:(lia)) as [Fd Vd].
  destruct (ffloor_correct (lo a * power_of_two (bits + 2))%D) as [Ff Vf]. rewrite G0 in Ff.
  destruct (fceil_correct (hi a * power_of_two (bits + 2))%D) as [Fc Vc]. rewrite G1 in Fc.
  replace (- bits - 2)%Z with (- (bits + 2))%Z in * by lia.
  destruct (fmul_inv _ _ G0) as (_ & _ & S0). destruct (fmul_inv _ _ G1) as (_ & _ & S1). rewrite Vu in S0, S1.
  rewrite rnd_id in S0, S1 by (apply format_scaled_up; [lia|apply val_format]).
  assert (F0 := grid_finite Zfloor _ _ (lo a) (bits + 2) Zfloor_IZR floor_small ltac:(lia) Ff ltac:(now rewrite Vf, S0) Fd Vd).
  assert (F1 := grid_finite Zceil _ _ (hi a) (bits + 2) Zceil_IZR ceil_small ltac:(lia) Fc ltac:(now rewrite Vc, S1) Fd Vd).
  destruct (lit_correct c_grid_zero eq_refl) as [_ Vz]. assert (Z0 : cval c_grid_zero = 0) by (unfold cval, c_grid_zero; simpl; ring).
  destruct (fadd_inv _ _ F0) as (F2 & _ & E2). destruct (fadd_inv _ _ F1) as (F3 & _ & E3).
  rewrite Vz, Z0, Rplus_0_r, rnd_id in E2 by apply val_format. rewrite Vz, Z0, Rplus_0_r, rnd_id in E3 by apply val_format.
  split; [exact F0|]. split; [exact F1|].
  destruct (grid_ends _ _ _ _ _ _ (bits + 2) ltac:(lia) Fu Vu Fd Vd G0 G1 Ff Vf Fc Vc F2 F3) as (E4 & E5 & O0 & O1).
  rewrite E2, E3. split; [exact O0|]. split; [exact O1|]. rewrite E4, E5.
  replace (- bits)%Z with (2 - (bits + 2))%Z by lia. apply grid_width; [lia|exact L|exact Fw|].
  replace (1 - (bits + 2))%Z with (- bits - 1)%Z by lia. exact W.
Qed.
