(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [WIT-NEAR] [WIT-HULL] The rounding of near_filter.h: sides moved to the safe side, products. The theorems about the C
    functions are in FiltersNearCode.v. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt.
Open Scope R_scope.

(* [WIT-NEAR] src/legal/star_filter.h: double ea = {} * s, *)
Definition c_near_side : const := (4728779608739021, -104)%Z.
(* [WIT-NEAR] src/legal/star_filter.h: lv * a1) - {} * s * s; *)
Definition c_near_det : const := (2281771080410813, -102)%Z.
(* [WIT-NEAR] src/legal/star_filter.h: k = {} * reach; *)
Definition c_near_k : const := (6839841934068941, -48)%Z.

(** ** Powers of two as decimal numbers *)

Lemma eta_323 : 10 ^ 323 * eta <= 1.
Proof.
  unfold eta. apply Rmult_le_reg_r with (bpow radix2 1075); [apply bpow_gt_0|].
  rewrite Rmult_assoc, <- bpow_plus. change (bpow radix2 (-1075 + 1075)) with 1. numerals. lra.
Qed.
Lemma least_side : 78 / 10 ^ 32 <= bpow radix2 (-100).
Proof.
  apply Rmult_le_reg_r with (bpow radix2 100); [apply bpow_gt_0|].
  rewrite <- bpow_plus. change (bpow radix2 (-100 + 100)) with 1. numerals. lra.
Qed.
Lemma least_reach : 4 / 10 ^ 91 <= bpow radix2 (-300).
Proof.
  apply Rmult_le_reg_r with (bpow radix2 300); [apply bpow_gt_0|].
  rewrite <- bpow_plus. change (bpow radix2 (-300 + 300)) with 1. numerals. lra.
Qed.
Lemma most_squares : bpow radix2 98 <= 4 * 10 ^ 29.
Proof. numerals. lra. Qed.
Lemma VV_big : 10 ^ 190 <= V * V / 2.
Proof. pose proof V_big. assert (10 ^ 100 * 10 ^ 100 <= V * V) by (apply Rmult_le_compat; lra). lra. Qed.

(** A small number does not overflow. *)
Lemma small_max x : Rabs x <= 10 ^ 190 -> Rabs (rnd x) < bpow radix2 1024.
Proof. intros H. apply rnd_below_max. pose proof VV_big. lra. Qed.

(** ** A difference that is surely positive *)

(** a approximates A to within 2.0005 u S; c is more than that times a computed S. *)
Lemma side_moved a A s S c ea : format a -> Rabs (a - A) <= 4001 / 1000 * u * (S / 2) + 3 * eta -> Rabs A <= S / 2 ->
  0 <= s -> Rabs (s - S) <= 601 / 100 * u * S + 7 * eta -> 20999 / 10000 * u <= c <= 3 * u -> ea = rnd (c * s) ->
  bpow radix2 (-100) <= rnd (a - ea) ->
  39 / 10 ^ 32 <= A /\ 0 <= rnd (a - ea) <= A * (1 + u) /\ A * (1 - u) <= rnd (a + ea) /\ 39 / 10 ^ 32 <= S.
Proof.
  intros Fa Ea MA Ps Es C -> G. pose proof least_side as K. pose proof eta_323 as H. pose proof eta_pos as EP.
  apply Rabs_le_inv in Ea. apply Rabs_le_inv in Es. pose proof (Rle_abs A) as AA.
  set (ea := rnd (c * s)) in *.
  assert (cs : 20999 / 10000 * u * s <= c * s) by (apply Rmult_le_compat_r; lra).
  assert (cs0 : 0 <= c * s) by (apply Rmult_le_pos; unfold u in C; lra).
  assert (Lea : c * s * (1 - u) - eta <= ea) by now apply rnd_lower.
  assert (Pea : 0 <= ea) by now apply rnd_pos.
  assert (P : 0 <= a - ea).
  { destruct (Rle_or_lt 0 (a - ea)) as [L|L]; [exact L|exfalso].
    assert (rnd (a - ea) <= 0) by (rewrite <- (round_0 radix2 fexp ZnearestE); apply rnd_le; lra). lra. }
  assert (U : rnd (a - ea) <= (a - ea) * (1 + u)) by (apply (rnd_add_upper a (- ea)); [exact Fa|apply format_opp,
    rnd_format|lra]).
  assert (L : (a + ea) * (1 - u) <= rnd (a + ea)) by (apply rnd_add_lower; [exact Fa|apply rnd_format|lra]).
  assert (LS : 39 / 10 ^ 32 <= S) by (unfold u in *; lra).
  assert (Less : a - ea <= A) by (unfold u in *; lra).
  assert (More : A <= a + ea) by (unfold u in *; lra).
  split; [unfold u in *; lra|]. split; [split; [lra|unfold u in *; lra]|]. split; [unfold u in *; lra|exact LS].
Qed.

(** The cross product of two differences, and its squares. *)
Lemma cross_side bx by_ cx cy BX BY CX CY S : diff bx BX -> diff by_ BY -> diff cx CX -> diff cy CY ->
  finite (cross bx by_ cx cy) -> Lift BX BY + Lift CX CY <= S ->
  Rabs (val (cross bx by_ cx cy) - (BX * CY - BY * CX)) <= 4001 / 1000 * u * (S / 2) + 3 * eta /\
  Rabs (BX * CY - BY * CX) <= S / 2.
Proof.
  intros D1 D2 D3 D4 F HS. destruct (cross_app _ _ _ _ _ _ _ _ D1 D2 D3 D4 F) as [M E].
  pose proof (Mcross_le BX BY CX CY) as ML. pose proof (Mcross_pos BX BY CX CY) as MP. pose proof eta_pos as EP.
  split; [|lra]. apply Rle_trans with (1 := E). apply Rplus_le_compat.
  - apply Rmult_le_compat; [unfold u; lra|exact MP|unfold u; lra|lra].
  - unfold h4, u; lra.
Qed.

(** Squares that are not tiny are right to five units. *)
Lemma lift_near x y X Y : diff x X -> diff y Y -> finite (lift x y) -> 10 ^ 20 * eta <= Lift X Y ->
  Lift X Y * (1 - 5 * u) <= val (lift x y) <= Lift X Y * (1 + 5 * u).
Proof.
  intros Dx Dy F L. destruct (lift_app _ _ _ _ Dx Dy F) as [_ E]. apply Rabs_le_inv in E.
  pose proof eta_pos. unfold h4, u in *; lra.
Qed.

(** A cross product bounds the squares of its vectors from below. *)
Lemma square_from_side A X Y : 39 / 10 ^ 32 <= A -> A * A <= X * Y -> 0 <= Y -> X <= 10 ^ 30 -> 15 / 10 ^ 92 <= Y.
Proof.
  intros PA C PY HX. assert (39 / 10 ^ 32 * (39 / 10 ^ 32) <= A * A) by (apply Rmult_le_compat; lra).
  assert (X * Y <= 10 ^ 30 * Y) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** ** Products without underflow *)

Lemma mul_low x' y' X Y : 0 <= X <= x' -> 0 <= Y <= y' -> / 10 ^ 305 <= X * Y -> X * Y * (1 - 2 * u) <= rnd (x' * y').
Proof.
  intros HX HY Q. assert (XY : X * Y <= x' * y') by (apply Rmult_le_compat; lra).
  apply Rle_trans with (rnd (X * Y)); [|now apply rnd_le].
  assert (X * Y * (1 - u) - eta <= rnd (X * Y)) by (apply rnd_lower; apply Rmult_le_pos; lra).
  pose proof eta_323. unfold u in *; lra.
Qed.
Lemma mul_up x' y' X Y : 0 <= x' <= X -> 0 <= y' <= Y -> / 10 ^ 305 <= X * Y -> rnd (x' * y') <= X * Y * (1 + 2 * u).
Proof.
  intros HX HY Q. assert (XY : x' * y' <= X * Y) by (apply Rmult_le_compat; lra).
  apply Rle_trans with (rnd (X * Y)); [now apply rnd_le|].
  assert (rnd (X * Y) <= X * Y * (1 + u) + eta) by (apply rnd_upper; apply Rmult_le_pos; lra).
  pose proof eta_323. unfold u in *; lra.
Qed.
(** Products of lower bounds. *)
Lemma below_product a b x y : 0 <= a -> 0 <= b -> a <= x -> b <= y -> a * b <= x * y.
Proof. intros. apply Rmult_le_compat; assumption. Qed.

(** The determinant, moved to the safe side. *)
Lemma det_moved d D s S : format d -> Rabs (d - D) <= 36671 / 10000 * u * (S * S) + 44 / 10 * eta * S + 7 * eta ->
  0 <= s -> Rabs (s - S) <= 601 / 100 * u * S + 7 * eta -> 39 / 10 ^ 32 <= S ->
  bpow radix2 (-300) <= rnd (d - rnd (rnd (cval c_near_det * s) * s)) ->
  39 / 10 ^ 92 <= D /\ 0 <= rnd (d - rnd (rnd (cval c_near_det * s) * s)) <= D * (1 + u).
Proof.
  intros Fd Ed Ps Es LS G. pose proof least_reach as K. pose proof eta_323 as H. pose proof eta_pos as EP.
  apply Rabs_le_inv in Ed. apply Rabs_le_inv in Es.
  assert (C : 4052 / 1000 * u <= cval c_near_det <= 5 * u) by (unfold c_near_det, u; split; numerals; lra).
  set (c := cval c_near_det) in *. set (q := rnd (c * s)) in *. set (b := rnd (q * s)) in *.
  assert (Ls : S * (1 - 7 * u) <= s) by (unfold u in *; lra).
  assert (Q : 4051 / 1000 * u * S <= q).
  { assert (c * s * (1 - u) - eta <= q) by (apply rnd_lower, Rmult_le_pos; [unfold u in C|]; lra).
    assert (4052 / 1000 * u * (S * (1 - 7 * u)) <= c * s) by (apply Rmult_le_compat; unfold u in *; lra).
    unfold u in *; lra. }
  assert (SS : 39 / 10 ^ 32 * S <= S * S) by (apply Rmult_le_compat_r; lra).
  assert (B : 405 / 100 * u * (S * S) <= b).
  { assert (Z : 0 <= q * s) by (apply Rmult_le_pos; unfold u in *; lra).
    assert (q * s * (1 - u) - eta <= b) by now apply rnd_lower.
    assert (4051 / 1000 * u * S * (S * (1 - 7 * u)) <= q * s) by (apply Rmult_le_compat; unfold u in *; lra).
    unfold u in *; lra. }
  assert (Less : d - b <= D).
  { assert (eta * S <= / 10 ^ 323 * S) by (apply Rmult_le_compat_r; lra). unfold u in *; lra. }
  assert (P : 0 <= d - b).
  { destruct (Rle_or_lt 0 (d - b)) as [L|L]; [exact L|exfalso].
    assert (rnd (d - b) <= 0) by (rewrite <- (round_0 radix2 fexp ZnearestE); apply rnd_le; lra). lra. }
  assert (U : rnd (d - b) <= (d - b) * (1 + u)) by (apply (rnd_add_upper d (- b)); [exact Fd|apply format_opp,
    rnd_format|lra]).
  split; [unfold u in *; lra|]. split; [lra|]. unfold u in *; lra.
Qed.

(** ** The last comparison *)

Lemma reach_scaled c k E : c <= cval k -> 1 <= c -> 4 / 10 ^ 91 <= E -> c * E * (1 - 2 * u) <= rnd (cval k * E).
Proof.
  intros C P L. pose proof eta_323. pose proof eta_pos.
  assert (c * E <= cval k * E) by (apply Rmult_le_compat_r; lra).
  assert (1 * E <= c * E) by (apply Rmult_le_compat_r; lra).
  assert (cval k * E * (1 - u) - eta <= rnd (cval k * E)) by (apply rnd_lower, Rmult_le_pos; lra).
  unfold u in *; lra.
Qed.

Lemma compared E lu lw LU LW y A2 m M det D x A1 : 4 / 10 ^ 91 <= E ->
  LU * (1 - 5 * u) <= lu -> LW * (1 - 5 * u) <= lw -> 15 / 10 ^ 92 <= LU -> 15 / 10 ^ 92 <= LW ->
  A2 * (1 - u) <= y -> 39 / 10 ^ 32 <= A2 ->
  7 / 10 ^ 89 <= m -> m <= M * (1 + / 10 ^ 12) -> 0 <= det <= D * (1 + u) -> 39 / 10 ^ 92 <= D ->
  0 <= x <= A1 * (1 + u) -> 39 / 10 ^ 32 <= A1 ->
  rnd (rnd (rnd (cval c_near_k * E) * rnd (lu * lw)) * y) < rnd (rnd (m * det) * x) ->
  2425 / 100 * E * (LU * LW) * A2 < M * D * A1.
Proof.
  intros LE Hu Hw LLU LLW Hy LA2 Lm Hm Hd LD Hx LA1 C.
  set (M' := M * (1 + / 10 ^ 12)) in *.
  assert (Q1 : LU * (1 - 5 * u) * (LW * (1 - 5 * u)) * (1 - 2 * u) <= rnd (lu * lw)).
  { apply mul_low; [unfold u in *; lra|unfold u in *; lra|].
    assert (14 / 10 ^ 92 * (14 / 10 ^ 92) <= LU * (1 - 5 * u) * (LW * (1 - 5 * u))) by (apply below_product; unfold u in
      *; lra).
    lra. }
  set (P := LU * LW) in *. assert (LP : 15 / 10 ^ 92 * (15 / 10 ^ 92) <= P) by (apply below_product; lra).
  assert (Q1' : P * (1 - 13 * u) <= rnd (lu * lw)).
  { apply Rle_trans with (2 := Q1).
    replace (LU * (1 - 5 * u) * (LW * (1 - 5 * u)) * (1 - 2 * u)) with (P * ((1 - 5 * u) * (1 - 5 * u) * (1 - 2 * u)))
      by (unfold P; ring).
    apply Rmult_le_compat_l; [lra|unfold u; lra]. }
  assert (Q2 : 24299 / 1000 * E * (1 - 2 * u) <= rnd (cval c_near_k * E)).
  { apply reach_scaled; [unfold c_near_k; numerals; lra|lra|exact LE]. }
  set (k := rnd (cval c_near_k * E)) in *. set (p := rnd (lu * lw)) in *.
  assert (EP : 4 / 10 ^ 91 * (225 / 10 ^ 184) <= E * P) by (apply below_product; lra).
  assert (Q3 : 24298 / 1000 * E * P <= rnd (k * p)).
  { apply Rle_trans with (24299 / 1000 * E * (1 - 2 * u) * (P * (1 - 13 * u)) * (1 - 2 * u)).
    - replace (24299 / 1000 * E * (1 - 2 * u) * (P * (1 - 13 * u)) * (1 - 2 * u)) with
        (E * P * (24299 / 1000 * (1 - 2 * u) * (1 - 13 * u) * (1 - 2 * u))) by ring. unfold u; lra.
    - apply mul_low; [unfold u in *; lra|unfold u in *; lra|].
      replace (24299 / 1000 * E * (1 - 2 * u) * (P * (1 - 13 * u))) with
        (E * P * (24299 / 1000 * (1 - 2 * u) * (1 - 13 * u))) by ring. unfold u; lra. }
  assert (EPA : 9 / 10 ^ 273 * (39 / 10 ^ 32) <= E * P * A2) by (apply below_product; lra).
  assert (Q4 : 24297 / 1000 * (E * P * A2) <= rnd (rnd (k * p) * y)).
  { apply Rle_trans with (24298 / 1000 * E * P * (A2 * (1 - u)) * (1 - 2 * u)).
    - replace (24298 / 1000 * E * P * (A2 * (1 - u)) * (1 - 2 * u)) with
        (E * P * A2 * (24298 / 1000 * (1 - u) * (1 - 2 * u))) by ring. unfold u; lra.
    - apply mul_low; [unfold u in *; lra|unfold u in *; lra|].
      replace (24298 / 1000 * E * P * (A2 * (1 - u))) with (E * P * A2 * (24298 / 1000 * (1 - u))) by ring.
      unfold u; lra. }
  assert (LM : 7 / 10 ^ 89 <= M') by lra.
  assert (MD : 7 / 10 ^ 89 * (39 / 10 ^ 92) <= M' * D) by (apply below_product; lra).
  assert (R1 : rnd (m * det) <= M' * D * (1 + 4 * u)).
  { apply Rle_trans with (M' * (D * (1 + u)) * (1 + 2 * u)).
    - apply mul_up; [lra|exact Hd|]. replace (M' * (D * (1 + u))) with (M' * D * (1 + u)) by ring. unfold u; lra.
    - replace (M' * (D * (1 + u)) * (1 + 2 * u)) with (M' * D * ((1 + u) * (1 + 2 * u))) by ring.
      apply Rmult_le_compat_l; [lra|unfold u; lra]. }
  assert (R1' : 0 <= rnd (m * det)) by (apply rnd_pos, Rmult_le_pos; lra).
  assert (MDA : 273 / 10 ^ 181 * (39 / 10 ^ 32) <= M' * D * A1) by (apply below_product; lra).
  assert (R2 : rnd (rnd (m * det) * x) <= M' * D * A1 * (1 + 8 * u)).
  { apply Rle_trans with (M' * D * (1 + 4 * u) * (A1 * (1 + u)) * (1 + 2 * u)).
    - apply mul_up; [lra|exact Hx|].
      replace (M' * D * (1 + 4 * u) * (A1 * (1 + u))) with (M' * D * A1 * ((1 + 4 * u) * (1 + u))) by ring. unfold u; lra.
    - replace (M' * D * (1 + 4 * u) * (A1 * (1 + u)) * (1 + 2 * u)) with
        (M' * D * A1 * ((1 + 4 * u) * (1 + u) * (1 + 2 * u))) by ring. apply Rmult_le_compat_l; [lra|unfold u; lra]. }
  replace (M' * D * A1) with (M * D * A1 * (1 + / 10 ^ 12)) in * by (unfold M'; ring).
  unfold u in *. lra.
Qed.
