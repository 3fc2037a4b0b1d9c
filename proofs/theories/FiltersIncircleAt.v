(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-INC] dyd_filter_incircle_at: a nonzero answer is the sign of the in-circle determinant of the exact
    representatives. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle.
Open Scope R_scope.

(* C src/skeleton/mesh_filter.h dyd_incircle_from
  double bc = dyd_seen_cross(b, c), ca = dyd_seen_cross(c, a), ab = dyd_seen_cross(a, b);
  return (dyd_incircle){a.square, b.square, c.square, bc, ca, ab};
*)
(* C src/skeleton/mesh_filter.h dyd_incircle_of
  return dyd_incircle_from(dyd_see(a, p), dyd_see(b, p), dyd_see(c, p));
*)
(* C src/skeleton/mesh_filter.h dyd_filter_incircle_at
  double d = i.la * i.bc + i.lb * i.ca + i.lc * i.ab;
  double s = i.la + i.lb + i.lc, e = s * s * DYD_INCIRCLE_BOUND + DYD_INCIRCLE_TINY;
  if (m->incircle_delta > 0) {
    double t = sqrt(s) + 8 * m->incircle_delta;
    e += 60 * m->incircle_delta * t * t * t;
  }
  if (d > e) return 1;
  return d < -e ? -1 : 0;
*)
Definition incircle_d (ax ay bx by_ cx cy : double) : double :=
  (term ax ay bx by_ cx cy + term bx by_ cx cy ax ay + term cx cy ax ay bx by_)%D.
Definition incircle_s (ax ay bx by_ cx cy : double) : double := (lift ax ay + lift bx by_ + lift cx cy)%D.
Definition incircle_e (delta s : double) : double :=
  let e := (s * s * lit c_incircle_bound + lit c_incircle_tiny)%D in
  if gt delta (lit c_zero) then
    let t := (fsqrt s + lit c_incircle_far * delta)%D in
    (e + lit c_incircle_delta * delta * t * t * t)%D
  else e.
Definition filter_incircle_at (delta ax ay bx by_ cx cy px py : double) : Z :=
  let ax := (ax - px)%D in let ay := (ay - py)%D in
  let bx := (bx - px)%D in let by_ := (by_ - py)%D in
  let cx := (cx - px)%D in let cy := (cy - py)%D in
  answer (incircle_d ax ay bx by_ cx cy) (incircle_e delta (incircle_s ax ay bx by_ cx cy)).

(** ** No overflow as long as the bound is finite *)

Notation V := (bpow radix2 512).

Lemma V_big : 10 ^ 100 <= V.
Proof. apply Rle_trans with (bpow radix2 400); [numerals; lra|apply bpow_le; lia]. Qed.
Lemma V2 : bpow radix2 1023 = V * V / 2.
Proof. rewrite <- bpow_plus. change (512 + 512)%Z with (1023 + 1)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2.
field. Qed.

Lemma below_max x : Rabs x <= V * V / 2 -> Rabs x < bpow radix2 1024.
Proof. intros H. apply Rle_lt_trans with (1 := H). rewrite <- V2. apply bpow_lt; lia. Qed.
Lemma rnd_below_max x : Rabs x <= V * V / 2 -> Rabs (rnd x) < bpow radix2 1024.
Proof.
  intros H. apply Rle_lt_trans with (bpow radix2 1023); [|apply bpow_lt; lia].
  rewrite <- rnd_abs. rewrite <- V2 in H. rewrite <- (rnd_id (bpow radix2 1023)); [now apply rnd_le|].
  apply generic_format_bpow. unfold FLT_exp; lia.
Qed.

Lemma square_finite s : finite (s * s)%D -> 0 <= val s -> val s < V.
Proof.
  intros F P. destruct (fmul_inv _ _ F) as (_ & _ & E). destruct (Rlt_or_le (val s) V) as [L|L]; [exact L|exfalso].
  assert (bpow radix2 1024 <= rnd (val s * val s)).
  { rewrite <- (rnd_id (bpow radix2 1024)); [|apply generic_format_bpow; unfold FLT_exp; lia].
    apply rnd_le. change 1024%Z with (512 + 512)%Z. rewrite bpow_plus. apply Rmult_le_compat; try assumption;
      apply bpow_ge_0. }
  generalize (val_lt_max (s * s)%D) (Rle_abs (val (s * s)%D)); lra.
Qed.

Lemma hterm_small l m : 0 <= l -> 0 <= m -> hterm l m <= (l + m + 1) / 10 ^ 20.
Proof.
  intros Pl Pm. unfold hterm. generalize eta_small eta_pos; intros S P.
  assert (0 <= eta * (l + m)) by (apply Rmult_le_pos; lra).
  assert (10 ^ 30 * eta * (l + m) <= 1 * (l + m)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma cross_finite bx by_ cx cy BX BY CX CY S : diff bx BX -> diff by_ BY -> diff cx CX -> diff cy CY ->
  finite bx -> finite by_ -> finite cx -> finite cy -> Lift BX BY + Lift CX CY <= S -> S <= 2 * V ->
  finite (cross bx by_ cx cy).
Proof.
  intros D1 D2 D3 D4 F1 F2 F3 F4 HS SV. pose proof V_big as VB. pose proof eta_small as ES. pose proof eta_pos as EP.
  pose proof (Mcross_le BX BY CX CY) as M.
  assert (VV : 10 ^ 100 * V <= V * V) by (apply Rmult_le_compat_r; lra).
  assert (P1 : app 3 eta (Rabs BX * Rabs CY) (rnd (val bx * val cy)) (BX * CY)) by (now apply (app_mul0 1 1)).
  assert (P2 : app 3 eta (Rabs BY * Rabs CX) (rnd (val by_ * val cx)) (BY * CX)) by (now apply (app_mul0 1 1)).
  assert (N1 : 0 <= Rabs BX * Rabs CY) by (apply Rmult_le_pos; apply Rabs_pos).
  assert (N2 : 0 <= Rabs BY * Rabs CX) by (apply Rmult_le_pos; apply Rabs_pos).
  unfold Mcross in M.
  assert (K3 : (1 + u) ^ 3 <= 2) by (unfold u; lra). assert (K4 : (1 + u) ^ 4 <= 2) by (unfold u; lra).
  destruct (fmul_finite bx cy F1 F4) as [G1 E1].
  { apply below_max. apply Rle_trans with (1 := app_magnitude _ _ _ _ _ P1).
    apply Rle_trans with (2 * (Rabs BX * Rabs CY) + eta); [apply Rplus_le_compat_r, Rmult_le_compat_r;
      assumption|lra]. }
  destruct (fmul_finite by_ cx F2 F3) as [G2 E2].
  { apply below_max. apply Rle_trans with (1 := app_magnitude _ _ _ _ _ P2).
    apply Rle_trans with (2 * (Rabs BY * Rabs CX) + eta); [apply Rplus_le_compat_r, Rmult_le_compat_r;
      assumption|lra]. }
  unfold cross. apply fsub_finite; try assumption. rewrite E1, E2.
  pose proof (app_sub _ _ _ _ _ _ _ _ _ (rnd_format _) (rnd_format _) P1 P2) as P.
  apply below_max. apply Rle_trans with (1 := app_magnitude _ _ _ _ _ P).
  apply Rle_trans with (2 * (Rabs BX * Rabs CY + Rabs BY * Rabs CX) + (1 + u) * (eta + eta)).
  - apply Rplus_le_compat_r, Rmult_le_compat_r; lra.
  - unfold u; lra.
Qed.

Lemma product_small l m S : 0 <= l -> 0 <= m -> m <= (S - l) / 2 -> l <= S -> S <= 101 / 100 * V ->
  0 <= l * m <= V * V * (13 / 100) /\ hterm l m <= V * V / 1000.
Proof.
  intros Pl Pm M L SV. pose proof V_big as VB.
  assert (VV : 10 ^ 100 * V <= V * V) by (apply Rmult_le_compat_r; lra).
  split; [split; [now apply Rmult_le_pos|]|].
  - apply Rle_trans with (l * ((S - l) / 2)); [apply Rmult_le_compat_l; assumption|].
    apply Rle_trans with (S * S / 8); [generalize (Rle_0_sqr (S - 2 * l)); unfold Rsqr; lra|].
    assert (S * S <= 101 / 100 * V * (101 / 100 * V)) by (apply Rmult_le_compat; lra). lra.
  - apply Rle_trans with (1 := hterm_small l m Pl Pm). lra.
Qed.

Section Finite.
Variables ax ay bx by_ cx cy : double.
Variables AX AY BX BY CX CY : R.
Variables (Dax : diff ax AX) (Day : diff ay AY) (Dbx : diff bx BX) (Dby : diff by_ BY) (Dcx : diff cx CX) (Dcy : diff
  cy CY).
Variables (Fax : finite ax) (Fay : finite ay) (Fbx : finite bx) (Fby : finite by_) (Fcx : finite cx) (Fcy : finite cy).
Variables (Fla : finite (lift ax ay)) (Flb : finite (lift bx by_)) (Flc : finite (lift cx cy)).
Let S := Lift AX AY + Lift BX BY + Lift CX CY.
Variable SV : S <= 101 / 100 * V.

Lemma lifts_pos : 0 <= Lift AX AY /\ 0 <= Lift BX BY /\ 0 <= Lift CX CY.
Proof. repeat split; apply Lift_pos. Qed.

Lemma incircle_d_parts :
  finite (term ax ay bx by_ cx cy + term bx by_ cx cy ax ay)%D /\ finite (term cx cy ax ay bx by_) /\
  Rabs (rnd (val (term ax ay bx by_ cx cy + term bx by_ cx cy ax ay)%D + val (term cx cy ax ay bx by_))
        - det3 AX AY BX BY CX CY) <= 36671 / 10000 * u * (S * S) + 44 / 10 * eta * S + 7 * eta.
Proof.
  destruct lifts_pos as (PA & PB & PC). pose proof V_big as VB. pose proof eta_pos as EP.
  assert (VV : 10 ^ 100 * V <= V * V) by (apply Rmult_le_compat_r; lra).
  assert (SV' : S <= 2 * V) by lra. unfold S in SV, SV'.
  assert (Xa : finite (cross bx by_ cx cy)).
  { apply (cross_finite _ _ _ _ _ _ _ _ (Lift AX AY + Lift BX BY + Lift CX CY) Dbx Dby Dcx Dcy); try assumption; lra. }
  assert (Xb : finite (cross cx cy ax ay)).
  { apply (cross_finite _ _ _ _ _ _ _ _ (Lift AX AY + Lift BX BY + Lift CX CY) Dcx Dcy Dax Day); try assumption; lra. }
  assert (Xc : finite (cross ax ay bx by_)).
  { apply (cross_finite _ _ _ _ _ _ _ _ (Lift AX AY + Lift BX BY + Lift CX CY) Dax Day Dbx Dby); try assumption; lra. }
  pose proof (term_app _ _ _ _ _ _ _ _ _ _ _ _ Dax Day Dbx Dby Dcx Dcy Fla Xa) as Ta.
  pose proof (term_app _ _ _ _ _ _ _ _ _ _ _ _ Dbx Dby Dcx Dcy Dax Day Flb Xb) as Tb.
  pose proof (term_app _ _ _ _ _ _ _ _ _ _ _ _ Dcx Dcy Dax Day Dbx Dby Flc Xc) as Tc.
  pose proof (Mcross_le BX BY CX CY) as Ma. pose proof (Mcross_le CX CY AX AY) as Mb.
  pose proof (Mcross_le AX AY BX BY) as Mc.
  pose proof (Mcross_pos BX BY CX CY) as Pa. pose proof (Mcross_pos CX CY AX AY) as Pb.
  pose proof (Mcross_pos AX AY BX BY) as Pc.
  destruct (product_small (Lift AX AY) (Mcross BX BY CX CY) (Lift AX AY + Lift BX BY + Lift CX CY)) as [Ka Ha]; try lra.
  destruct (product_small (Lift BX BY) (Mcross CX CY AX AY) (Lift AX AY + Lift BX BY + Lift CX CY)) as [Kb Hb]; try lra.
  destruct (product_small (Lift CX CY) (Mcross AX AY BX BY) (Lift AX AY + Lift BX BY + Lift CX CY)) as [Kc Hc]; try lra.
  assert (P9 : (1 + u) ^ 9 <= 11 / 10) by (unfold u; lra). assert (P10 : (1 + u) ^ 10 <= 11 / 10) by (unfold u; lra).
  assert (Big : forall k h m x' x, app k h m x' x -> (1 + u) ^ k <= 11 / 10 -> m <= V * V * (26 / 100) -> h <= V * V /
    100 ->
    Rabs x' < bpow radix2 1024).
  { intros k h m x' x A K M H. apply below_max. pose proof (app_m_pos _ _ _ _ _ A).
    apply Rle_trans with (1 := app_magnitude _ _ _ _ _ A).
    apply Rle_trans with (11 / 10 * m + h); [apply Rplus_le_compat_r, Rmult_le_compat_r; assumption|lra]. }
  unfold term.
  destruct (fmul_finite _ _ Fla Xa) as [Fa Ea]; [apply (Big _ _ _ _ _ Ta P9); lra|].
  destruct (fmul_finite _ _ Flb Xb) as [Fb Eb]; [apply (Big _ _ _ _ _ Tb P9); lra|].
  destruct (fmul_finite _ _ Flc Xc) as [Fc Ec]; [apply (Big _ _ _ _ _ Tc P9); lra|].
  pose proof (app_add _ _ _ _ _ _ _ _ _ (rnd_format _) (rnd_format _) Ta Tb) as Tab.
  destruct (fadd_finite _ _ Fa Fb) as [Fab Eab].
  { rewrite Ea, Eb. apply (Big _ _ _ _ _ Tab P10); [lra|]. unfold u; lra. }
  split; [exact Fab|split; [exact Fc|]]. rewrite Eab, Ea, Eb, Ec.
  pose proof (sum_app _ _ _ _ _ _ _ _ _ _ _ _ (rnd_format _) (rnd_format _) (rnd_format _) PA Pa PB Pb PC Pc Ta Tb Tc)
    as Sum.
  unfold det3. fold (Lift AX AY) (Lift BX BY) (Lift CX CY). apply Rle_trans with (1 := Sum).
  assert (Q : Lift AX AY * Mcross BX BY CX CY + Lift BX BY * Mcross CX CY AX AY + Lift CX CY * Mcross AX AY BX BY
              <= S * S / 3).
  { assert (Q1 : Lift AX AY * Mcross BX BY CX CY <= Lift AX AY * ((Lift BX BY + Lift CX CY) / 2)) by (apply
    Rmult_le_compat_l; assumption).
    assert (Q2 : Lift BX BY * Mcross CX CY AX AY <= Lift BX BY * ((Lift CX CY + Lift AX AY) / 2)) by (apply
      Rmult_le_compat_l; assumption).
    assert (Q3 : Lift CX CY * Mcross AX AY BX BY <= Lift CX CY * ((Lift AX AY + Lift BX BY) / 2)) by (apply
      Rmult_le_compat_l; assumption).
    unfold S. generalize (Rle_0_sqr (Lift AX AY - Lift BX BY)) (Rle_0_sqr (Lift BX BY - Lift CX CY)) (Rle_0_sqr (Lift
      CX CY - Lift AX AY)).
    unfold Rsqr. lra. }
  assert (Q' : 11001 / 1000 * u * (Lift AX AY * Mcross BX BY CX CY + Lift BX BY * Mcross CX CY AX AY + Lift CX CY *
    Mcross AX AY BX BY)
     <= 11001 / 1000 * u * (S * S / 3)) by (apply Rmult_le_compat_l; [unfold u; lra|exact Q]).
  assert (Q2 : 22 / 10 * eta * (Lift AX AY + Mcross BX BY CX CY + Lift BX BY + Mcross CX CY AX AY + Lift CX CY +
    Mcross AX AY BX BY)
     <= 22 / 10 * eta * (2 * S)) by (apply Rmult_le_compat_l; [lra|unfold S; lra]).
  assert (0 <= S * S) by (apply Rle_0_sqr). unfold u in *. lra.
Qed.
End Finite.

(** The computed sum of the three squares. *)
Lemma incircle_s_error ax ay bx by_ cx cy AX AY BX BY CX CY :
  diff ax AX -> diff ay AY -> diff bx BX -> diff by_ BY -> diff cx CX -> diff cy CY ->
  finite (incircle_s ax ay bx by_ cx cy) ->
  let S := Lift AX AY + Lift BX BY + Lift CX CY in
  Rabs (val (incircle_s ax ay bx by_ cx cy) - S) <= 601 / 100 * u * S + 7 * eta.
Proof.
  intros D1 D2 D3 D4 D5 D6 F S. unfold incircle_s in *. destruct (fadd_inv _ _ F) as (F1 & F2 & E).
  destruct (fadd_inv _ _ F1) as (F3 & F4 & E1). rewrite E, E1.
  pose proof (lift_app _ _ _ _ D1 D2 F3) as A. pose proof (lift_app _ _ _ _ D3 D4 F4) as B.
  pose proof (lift_app _ _ _ _ D5 D6 F2) as C.
  pose proof (app_add _ _ _ _ _ _ _ _ _ (val_format _) (val_format _) A B) as AB.
  assert (C' : app 5 h4 (Lift CX CY) (val (lift cx cy)) (Lift CX CY)) by (apply app_weaken with (1 := C);
    [lia|lra|lra]).
  pose proof (app_add _ _ _ _ _ _ _ _ _ (rnd_format _) (val_format _) AB C') as T.
  pose proof (app_m_pos _ _ _ _ _ T) as M. destruct T as [_ T]. fold S in T, M. apply Rle_trans with (1 := T).
  assert (((1 + u) ^ 6 - 1) * S <= 601 / 100 * u * S) by (apply Rmult_le_compat_r; [exact M|unfold u; lra]).
  generalize eta_pos; intros EP. unfold h4, u in *; lra.
Qed.

(** ** The bound from below *)

Lemma bound_lower s S : format s -> 0 <= s -> 0 <= S -> Rabs (s - S) <= 601 / 100 * u * S + 7 * eta ->
  404 / 100 * u * (S * S) + 5 * eta * S + 1000 * eta <=
  rnd (rnd (rnd (s * s) * cval c_incircle_bound) + cval c_incircle_tiny).
Proof.
  intros Fs Ps PS H. apply Rabs_le_inv in H. generalize eta_pos eta_small; intros EP ES.
  assert (T : 10 ^ 80 * eta <= cval c_incircle_tiny).
  { unfold c_incircle_tiny, cval, fst, snd. rewrite bpow_eta, Rmult_1_l. apply Rmult_le_compat_r; [lra|].
    simpl (-790 + 1075)%Z. numerals; lra. }
  assert (FT : format (cval c_incircle_tiny)) by (rewrite <- (proj2 (lit_correct c_incircle_tiny eq_refl));
    apply val_format).
  assert (C : 4053 / 1000 * u <= cval c_incircle_bound <= u * 5) by (unfold c_incircle_bound, u; split; numerals; lra).
  assert (SS : 0 <= S * S) by (apply Rle_0_sqr).
  assert (ES' : 0 <= eta * S) by (apply Rmult_le_pos; lra).
  assert (Q0 : S * S * (1 - 1203 / 100 * u) - 15 * (eta * S) <= s * s).
  { destruct (Rle_or_lt (S * (1 - 601 / 100 * u)) (7 * eta)) as [L|L].
    - assert (S <= 8 * eta) by (unfold u in *; lra).
      assert (S * S <= 8 * eta * S) by (apply Rmult_le_compat_r; assumption).
      assert (0 <= s * s) by (apply Rle_0_sqr). unfold u; lra.
    - assert ((S * (1 - 601 / 100 * u) - 7 * eta) * (S * (1 - 601 / 100 * u) - 7 * eta) <= s * s) by (apply
      Rmult_le_compat; lra).
      assert (0 <= eta * eta) by (apply Rle_0_sqr). unfold u in *; lra. }
  set (q1 := rnd (s * s)).
  assert (Q1 : s * s * (1 - u) - eta <= q1) by (apply rnd_lower, Rle_0_sqr).
  assert (Q1' : 0 <= q1) by (apply rnd_pos, Rle_0_sqr).
  set (q2 := rnd (q1 * cval c_incircle_bound)).
  assert (Q2 : q1 * cval c_incircle_bound * (1 - u) - eta <= q2) by (apply rnd_lower, Rmult_le_pos; unfold u in C; lra).
  assert (Q2' : 0 <= q2) by (apply rnd_pos, Rmult_le_pos; unfold u in C; lra).
  assert (Q3 : (q2 + cval c_incircle_tiny) * (1 - u) <= rnd (q2 + cval c_incircle_tiny)) by (apply rnd_add_lower;
    [apply rnd_format|exact FT|lra]).
  apply Rle_trans with (2 := Q3).
  assert (K1 : S * S * (1 - 1304 / 100 * u) - 15 * (eta * S) - eta <= q1) by (unfold u in *; lra).
  assert (K2 : 4053 / 1000 * u * q1 <= q1 * cval c_incircle_bound) by (rewrite Rmult_comm; apply Rmult_le_compat_l;
    lra).
  assert (K3 : 4052 / 1000 * u * (S * S) - 70 * u * (eta * S) - 2 * eta <= q2) by (unfold u in *; lra).
  assert (K4 : eta * S <= eta + u / 10 ^ 5 * (S * S)).
  { destruct (Rle_or_lt S 1) as [L|L].
    - assert (eta * S <= eta * 1) by (apply Rmult_le_compat_l; lra). unfold u; lra.
    - assert (S * 1 <= S * S) by (apply Rmult_le_compat_l; lra).
      assert (eta * S <= u / 10 ^ 5 * S) by (apply Rmult_le_compat_r; unfold u; lra).
      assert (u / 10 ^ 5 * S <= u / 10 ^ 5 * (S * S)) by (apply Rmult_le_compat_l; unfold u; lra). lra. }
  unfold u in *; lra.
Qed.

(** What the representatives' own error adds. *)
Lemma delta_lower delta t : format delta -> 2 * eta <= delta -> 0 <= t ->
  578 / 10 * (delta * (t * t * t)) - 3 * eta <=
  rnd (rnd (rnd (rnd (cval c_incircle_delta * delta) * t) * t) * t).
Proof.
  intros Fd D Pt. generalize eta_pos; intros EP.
  assert (C : cval c_incircle_delta = 60) by (unfold c_incircle_delta; numerals; lra). rewrite C.
  set (q1 := rnd (60 * delta)).
  assert (Q1 : 59 * delta <= q1).
  { assert (60 * delta * (1 - u) - eta <= q1) by (apply rnd_lower; lra). unfold u in *; lra. }
  set (q2 := rnd (q1 * t)).
  assert (Q2 : 59 * delta * t * (1 - u) - eta <= q2).
  { apply Rle_trans with (q1 * t * (1 - u) - eta); [|apply rnd_lower, Rmult_le_pos; lra].
    assert (59 * delta * t * (1 - u) <= q1 * t * (1 - u)); [|lra].
    apply Rmult_le_compat_r; [unfold u; lra|]. apply Rmult_le_compat_r; assumption. }
  assert (Q2' : 0 <= q2) by (apply rnd_pos, Rmult_le_pos; lra).
  set (q3 := rnd (q2 * t)).
  assert (dtt : 0 <= delta * (t * t)) by (repeat apply Rmult_le_pos; lra).
  assert (dt3 : 0 <= delta * (t * t * t)) by (repeat apply Rmult_le_pos; lra).
  assert (et : 0 <= eta * t) by (apply Rmult_le_pos; lra).
  assert (ett : 0 <= eta * (t * t)) by (repeat apply Rmult_le_pos; lra).
  assert (Q3 : 589 / 10 * (delta * (t * t)) - eta * t - eta <= q3).
  { apply Rle_trans with (q2 * t * (1 - u) - eta); [|apply rnd_lower, Rmult_le_pos; lra].
    assert ((59 * delta * t * (1 - u) - eta) * t <= q2 * t) by (apply Rmult_le_compat_r; assumption).
    unfold u in *; lra. }
  assert (Q3' : 0 <= q3) by (apply rnd_pos, Rmult_le_pos; lra).
  apply Rle_trans with (q3 * t * (1 - u) - eta); [|apply rnd_lower, Rmult_le_pos; lra].
  assert (K : (589 / 10 * (delta * (t * t)) - eta * t - eta) * t <= q3 * t) by (apply Rmult_le_compat_r; assumption).
  assert (E : eta * (t * t) + eta * t <= delta * (t * t * t) * (99 / 100) + 2 * eta \/ eta * (t * t) + eta * t <= 2 *
    eta * (t * t * t)).
  { destruct (Rle_or_lt t 1) as [L|L]; [left|right].
    - assert (t * t <= 1 * 1) by (apply Rmult_le_compat; lra).
      assert (eta * (t * t) <= eta * 1) by (apply Rmult_le_compat_l; lra).
      assert (eta * t <= eta * 1) by (apply Rmult_le_compat_l; lra). lra.
    - assert (1 <= t * t) by nra.
      assert (t * t * 1 <= t * t * t) by (apply Rmult_le_compat_l; lra).
      assert (t * 1 <= t * (t * t)) by (apply Rmult_le_compat_l; lra).
      assert (eta * (t * t) <= eta * (t * t * t)) by (apply Rmult_le_compat_l; lra).
      assert (eta * t <= eta * (t * t * t)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (E2 : 2 * eta * (t * t * t) <= delta * (t * t * t)) by (apply Rmult_le_compat_r; [repeat apply Rmult_le_pos;
    lra|exact D]).
  assert (E3 : eta * (t * t) + eta * t <= delta * (t * t * t) + 2 * eta) by (destruct E; lra).
  unfold u in *; lra.
Qed.

(** 2^-535 is above the root of all underflow. *)
Notation z := (bpow radix2 (-535)).
Lemma z2 : z * z = 32 * eta.
Proof. rewrite <- bpow_plus, bpow_eta. simpl (-535 + -535 + 1075)%Z. change (bpow radix2 5) with 32. ring. Qed.

Lemma t_lower s S delta : format s -> format delta -> 0 <= s -> 0 <= S -> 0 <= delta ->
  Rabs (s - S) <= 601 / 100 * u * S + 7 * eta ->
  let t := rnd (rnd (sqrt s) + rnd (cval c_incircle_far * delta)) in
  0 <= t /\ delta <= t / 7 + eta /\ sqrt S + 283 / 100 * delta <= 1001 / 1000 * t + z.
Proof.
  intros Fs Fd Ps PS Pd H t. apply Rabs_le_inv in H. generalize eta_pos eta_small z2 (bpow_gt_0 radix2 (-535));
    intros EP ES Z2 Zp.
  assert (E8 : rnd (cval c_incircle_far * delta) = 8 * delta).
  { replace (cval c_incircle_far * delta) with (2 * (2 * (2 * delta))) by (unfold c_incircle_far; numerals; ring).
    rewrite rnd_id by (repeat apply format_double; exact Fd). ring. }
  pose proof (sqrt_pos s) as R0.
  assert (Q1 : sqrt s * (1 - u) - eta <= rnd (sqrt s)) by now apply rnd_lower.
  assert (Q1' : 0 <= rnd (sqrt s)) by now apply rnd_pos.
  assert (Q2 : (rnd (sqrt s) + 8 * delta) * (1 - u) <= t).
  { unfold t; rewrite E8. apply rnd_add_lower; [apply rnd_format|rewrite <- E8; apply rnd_format|lra]. }
  assert (Pt : 0 <= t) by (unfold t; rewrite E8; apply rnd_pos; lra).
  assert (ez : eta <= z / 100).
  { destruct (Rle_or_lt eta (z / 100)) as [L|L]; [exact L|exfalso].
    assert (z * z <= 100 * eta * (100 * eta)) by (apply Rmult_le_compat; lra). nra. }
  split; [exact Pt|split; [unfold u in *; lra|]].
  assert (R1 : sqrt S <= sqrt s * (1 + 4 * u) + z * (98 / 100)).
  { apply Rsqr_incr_0; [|apply sqrt_pos|].
    - unfold Rsqr. rewrite sqrt_sqrt by exact PS.
      assert (S1 : S <= s * (1 + 7 * u) + 8 * eta) by (unfold u in *; lra).
      apply Rle_trans with (1 := S1). pose proof (sqrt_sqrt s Ps) as SQ.
      assert (0 <= sqrt s * z) by (apply Rmult_le_pos; lra).
      replace ((sqrt s * (1 + 4 * u) + z * (98 / 100)) * (sqrt s * (1 + 4 * u) + z * (98 / 100))) with
        (sqrt s * sqrt s * ((1 + 4 * u) * (1 + 4 * u)) + 2 * (98 / 100) * (1 + 4 * u) * (sqrt s * z) + z * z * (98 /
          100 * (98 / 100))) by ring.
      rewrite SQ, Z2. unfold u; lra.
    - apply Rplus_le_le_0_compat; [apply Rmult_le_pos; [lra|unfold u; lra]|lra]. }
  unfold u in *; lra.
Qed.

Lemma moved_bound S delta t : 0 <= t -> 0 <= delta -> delta <= t / 7 + eta -> 0 <= sqrt S ->
  sqrt S + 283 / 100 * delta <= 1001 / 1000 * t + z ->
  let T := sqrt S + 283 / 100 * delta in 34 * delta * (T * T * T) <= 36 * (delta * (t * t * t)) + eta.
Proof.
  intros Pt Pd D Ps H T. fold T in H. generalize eta_pos eta_small z2 (bpow_gt_0 radix2 (-535)); intros EP ES Z2 Zp.
  assert (PT : 0 <= T) by (unfold T; lra).
  assert (t3 : 0 <= t * t * t) by (repeat apply Rmult_le_pos; assumption).
  assert (dt3 : 0 <= delta * (t * t * t)) by now apply Rmult_le_pos.
  assert (ez : eta <= z / 100).
  { destruct (Rle_or_lt eta (z / 100)) as [L|L]; [exact L|exfalso].
    assert (z * z <= 100 * eta * (100 * eta)) by (apply Rmult_le_compat; lra). nra. }
  assert (C3 : forall x y, 0 <= x -> x <= y -> x * x * x <= y * y * y).
  { intros x y Px L. repeat apply Rmult_le_compat; try assumption; repeat apply Rmult_le_pos; assumption. }
  destruct (Rle_or_lt z (t / 100)) as [L|L].
  - assert (K := C3 T (1011 / 1000 * t) PT ltac:(lra)).
    assert (K2 : 34 * delta * (T * T * T) <= 34 * delta * (1011 / 1000 * t * (1011 / 1000 * t) * (1011 / 1000 * t)))
      by (apply Rmult_le_compat_l; lra).
    lra.
  - assert (K := C3 T (102 * z) PT ltac:(lra)).
    assert (z3 : 0 <= z * z * z) by (repeat apply Rmult_le_pos; lra).
    assert (K2 : 34 * delta * (T * T * T) <= 34 * (15 * z) * (102 * z * (102 * z) * (102 * z))).
    { apply Rmult_le_compat; try lra. repeat apply Rmult_le_pos; assumption. }
    replace (34 * (15 * z) * (102 * z * (102 * z) * (102 * z))) with (541216080 * ((z * z) * (z * z))) in K2 by ring.
    rewrite Z2 in K2. pose proof eta2. lra.
Qed.

(** ** The theorem *)

Lemma incircle_e_nneg delta s : nneg delta -> nneg (incircle_e delta s).
Proof.
  intros Nd. unfold incircle_e. cbv zeta.
  assert (N : nneg (s * s * lit c_incircle_bound + lit c_incircle_tiny)%D).
  { apply nneg_add; [apply nneg_mul; [apply nneg_sqr|]|]; (apply nneg_lit; [reflexivity|simpl; lia]). }
  destruct (gt delta (lit c_zero)); [|exact N].
  assert (nneg (fsqrt s + lit c_incircle_far * delta)%D).
  { apply nneg_add; [apply nneg_sqrt|apply nneg_mul; [apply nneg_lit; [reflexivity|simpl; lia]|exact Nd]]. }
  apply nneg_add; [exact N|]. repeat apply nneg_mul; try assumption. apply nneg_lit; [reflexivity|simpl; lia].
Qed.

Lemma diff_sub a p : finite (a - p)%D -> diff (a - p)%D (val a - val p).
Proof.
  intros F. destruct (fsub_inv _ _ F) as (_ & _ & E). unfold diff. rewrite E. apply app_diff; apply val_format.
Qed.

Lemma lift_nonneg x y : finite (lift x y) -> 0 <= val (lift x y).
Proof.
  intros F. apply nneg_val. unfold lift. apply nneg_add; apply nneg_sqr.
Qed.

(** A finite bound is a real bound. *)
Lemma incircle_e_finite delta s S : finite delta -> 0 <= val delta -> 0 <= val s -> 0 <= S ->
  finite (incircle_e delta s) -> Rabs (val s - S) <= 601 / 100 * u * S + 7 * eta ->
  finite (s * s)%D /\
  36671 / 10000 * u * (S * S) + 44 / 10 * eta * S + 7 * eta
    + 34 * val delta * ((sqrt S + 283 / 100 * val delta) * (sqrt S + 283 / 100 * val delta) * (sqrt S + 283 / 100 *
      val delta))
  < val (incircle_e delta s).
Proof.
  intros Fd Pd Ps PS F H. generalize eta_pos; intros EP.
  assert (SS : 0 <= S * S) by (apply Rle_0_sqr). assert (ES : 0 <= eta * S) by (apply Rmult_le_pos; lra).
  destruct (lit_correct c_zero eq_refl) as [Fz Vz].
  assert (Z0 : cval c_zero = 0) by (unfold cval; simpl; lra).
  generalize (gt_finite delta (lit c_zero) Fd Fz); rewrite Vz, Z0. intros I.
  unfold incircle_e in *. cbv zeta in *.
  assert (Low : finite (s * s * lit c_incircle_bound + lit c_incircle_tiny)%D -> finite (s * s)%D /\
    404 / 100 * u * (S * S) + 5 * eta * S + 1000 * eta <= val (s * s * lit c_incircle_bound + lit c_incircle_tiny)%D).
  { intros F1. destruct (fadd_inv _ _ F1) as (F2 & _ & E1). destruct (fmul_inv _ _ F2) as (F3 & _ & E2).
    destruct (fmul_inv _ _ F3) as (F4 & _ & E3). split; [exact F3|].
    rewrite E3 in E2. rewrite E2 in E1. lits E1. rewrite E1. now apply bound_lower; [apply val_format| | |]. }
  destruct (gt delta (lit c_zero)) eqn:G.
  - assert (Pd' : 0 < val delta) by now apply I.
    destruct (fadd_inv _ _ F) as (F1 & F2 & E). destruct (Low F1) as [Fss L].
    split; [exact Fss|].
    destruct (fmul_inv _ _ F2) as (F3 & Ft & E2). destruct (fmul_inv _ _ F3) as (F4 & _ & E3).
    destruct (fmul_inv _ _ F4) as (F5 & _ & E4). destruct (fmul_inv _ _ F5) as (_ & _ & E5).
    destruct (fadd_inv _ _ Ft) as (F6 & F7 & E6). destruct (fsqrt_inv _ F6) as (_ & _ & E7).
    destruct (fmul_inv _ _ F7) as (_ & _ & E8).
    rewrite E7, E8 in E6. lits E6. rewrite E5 in E4. rewrite E4 in E3. rewrite E3 in E2. lits E2.
    set (t := (fsqrt s + lit c_incircle_far * delta)%D) in *.
    assert (D2 : 2 * eta <= val delta).
    { replace (2 * eta) with (bpow radix2 (-1074)) by (rewrite bpow_eta; simpl (-1074 + 1075)%Z;
      change (bpow radix2 1) with 2; ring).
      rewrite <- (Rabs_pos_eq (val delta)) by lra. apply (abs_B2R_ge_emin 53 1024 delta).
      clear - Fd Pd'. destruct delta; try discriminate Fd; [simpl in Pd'; lra|reflexivity]. }
    destruct (t_lower (val s) S (val delta) (val_format _) (val_format _) Ps PS Pd H) as (Pt & Dt & Tt).
    cbv zeta in Pt, Dt, Tt. rewrite <- E6 in Pt, Dt, Tt.
    pose proof (moved_bound S (val delta) (val t) Pt Pd Dt (sqrt_pos _) Tt) as M. cbv zeta in M.
    pose proof (delta_lower (val delta) (val t) (val_format _) D2 Pt) as Q. rewrite <- E2 in Q.
    set (e1 := (s * s * lit c_incircle_bound + lit c_incircle_tiny)%D) in *.
    set (q := (lit c_incircle_delta * delta * t * t * t)%D) in *.
    assert (dt3 : 0 <= val delta * (val t * val t * val t)) by (repeat apply Rmult_le_pos; assumption).
    assert (Pq : 0 <= val q) by (rewrite E2; apply rnd_pos, Rmult_le_pos; [|exact Pt]; apply rnd_pos, Rmult_le_pos;
      [|exact Pt];
      apply rnd_pos, Rmult_le_pos; [|exact Pt]; apply rnd_pos, Rmult_le_pos; [unfold c_incircle_delta; numerals;
        lra|exact Pd]).
    rewrite E.
    assert (U : (val e1 + val q) * (1 - u) <= rnd (val e1 + val q)).
    { apply rnd_add_lower; try apply val_format. unfold u in *; lra. }
    apply Rlt_le_trans with (2 := U). clear - M Q L dt3 EP SS ES. unfold u in *. lra.
  - destruct (Low F) as [Fss L]. split; [exact Fss|].
    assert (Z : val delta = 0).
    { destruct (Rle_or_lt (val delta) 0) as [K|K]; [lra|]. destruct I as [_ I]; discriminate (I K). }
    rewrite Z, Rmult_0_r, Rmult_0_l, Rplus_0_r. clear - L EP SS ES. unfold u in *. lra.
Qed.

Theorem filter_incircle_at_correct delta ax ay bx by_ cx cy px py ax' ay' bx' by_' cx' cy' px' py' :
  finite delta -> 0 <= val delta ->
  let close (x : double) (x' : R) := Rabs (x' - val x) <= val delta in
  close ax ax' -> close ay ay' -> close bx bx' -> close by_ by_' ->
  close cx cx' -> close cy cy' -> close px px' -> close py py' ->
  let sign := filter_incircle_at delta ax ay bx by_ cx cy px py in
  (sign = 1%Z -> 0 < incircle ax' ay' bx' by_' cx' cy' px' py') /\
  (sign = (-1)%Z -> incircle ax' ay' bx' by_' cx' cy' px' py' < 0).
Proof.
  intros Fd Pd close C1 C2 C3 C4 C5 C6 C7 C8 sign. unfold sign, filter_incircle_at. cbv zeta.
  set (s := incircle_s _ _ _ _ _ _). set (e := incircle_e delta s). set (d := incircle_d _ _ _ _ _ _).
  enough (G : finite e -> (gt d e = true -> 0 < incircle ax' ay' bx' by_' cx' cy' px' py') /\
    (lt d (- e) = true -> incircle ax' ay' bx' by_' cx' cy' px' py' < 0)).
  { apply answer_correct; [|intros F; apply G..]; try assumption. now apply incircle_e_nneg, nneg_of_val. }
  intros Fe. generalize eta_pos; intros EP.
  assert (Fs : finite s).
  { assert (Fss : finite (s * s)%D).
    { assert (K : finite (s * s * lit c_incircle_bound + lit c_incircle_tiny)%D -> finite (s * s)%D).
      { intros K. exact (proj1 (fmul_inv _ _ (proj1 (fadd_inv _ _ K)))). }
      unfold e, incircle_e in Fe. cbv zeta in Fe. destruct (gt delta (lit c_zero)); apply K; [|exact Fe].
      exact (proj1 (fadd_inv _ _ Fe)). }
    exact (proj1 (fmul_inv _ _ Fss)). }
  pose proof Fs as Fs'. unfold s, incircle_s in Fs'. destruct (fadd_inv _ _ Fs') as (Fab & Flc & _).
  destruct (fadd_inv _ _ Fab) as (Fla & Flb & _).
  destruct (fadd_inv _ _ Fla) as (M1 & M2 & _). destruct (fadd_inv _ _ Flb) as (M3 & M4 & _).
  destruct (fadd_inv _ _ Flc) as (M5 & M6 & _).
  destruct (fmul_inv _ _ M1) as (Fax & _ & _). destruct (fmul_inv _ _ M2) as (Fay & _ & _).
  destruct (fmul_inv _ _ M3) as (Fbx & _ & _). destruct (fmul_inv _ _ M4) as (Fby & _ & _).
  destruct (fmul_inv _ _ M5) as (Fcx & _ & _). destruct (fmul_inv _ _ M6) as (Fcy & _ & _).
  pose proof (diff_sub _ _ Fax) as D1. pose proof (diff_sub _ _ Fay) as D2. pose proof (diff_sub _ _ Fbx) as D3.
  pose proof (diff_sub _ _ Fby) as D4. pose proof (diff_sub _ _ Fcx) as D5. pose proof (diff_sub _ _ Fcy) as D6.
  pose proof (incircle_s_error _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fs) as ES. cbv zeta in ES. fold s in ES.
  set (S := Lift _ _ + Lift _ _ + Lift _ _) in ES.
  assert (PS : 0 <= S).
  { unfold S; generalize (Lift_pos (val ax - val px) (val ay - val py)) (Lift_pos (val bx - val px) (val by_ - val py))
      (Lift_pos (val cx - val px) (val cy - val py)); lra. }
  assert (Ps : 0 <= val s).
  { apply nneg_val. unfold s, incircle_s, lift. repeat apply nneg_add; apply nneg_sqr. }
  destruct (incircle_e_finite delta s S Fd Pd Ps PS Fe ES) as [Fss Low]. fold e in Low.
  pose proof (square_finite s Fss Ps) as sV. pose proof V_big as VB.
  assert (SV : S <= 101 / 100 * V) by (apply Rabs_le_inv in ES; generalize eta_small; unfold u in *; lra).
  destruct (incircle_d_parts _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fax Fay Fbx Fby Fcx Fcy Fla Flb Flc SV) as (Fs1
    & Fs2 & Err).
  fold S in Err.
  set (r := sqrt S). assert (Pr : 0 <= r) by apply sqrt_pos.
  assert (rr : r * r = S) by now apply sqrt_sqrt.
  assert (Mv : Rabs (incircle ax' ay' bx' by_' cx' cy' px' py' -
      incircle (val ax) (val ay) (val bx) (val by_) (val cx) (val cy) (val px) (val py)) <=
    34 * val delta * ((r + 283 / 100 * val delta) * (r + 283 / 100 * val delta) * (r + 283 / 100 * val delta))).
  { apply incircle_moved; try assumption; rewrite rr; unfold S;
      generalize (Lift_pos (val ax - val px) (val ay - val py)) (Lift_pos (val bx - val px) (val by_ - val py))
        (Lift_pos (val cx - val px) (val cy - val py)); lra. }
  destruct (conclude _ _ _ _ _ (val e) Err Mv Low) as [Pos Neg].
  split; intros G.
  - apply Pos, (fadd_gt _ _ _ Fs1 Fs2 Fe G).
  - apply Neg. rewrite <- fopp_val. apply (fadd_lt _ _ _ Fs1 Fs2); [now rewrite fopp_finite|exact G].
Qed.
