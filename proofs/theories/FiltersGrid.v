(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-GRID] Rounding outward to multiples of 2^-k in doubles: nothing is rounded but by floor and ceil. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError.
Open Scope R_scope.

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

(** ** What is a double *)

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
