(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-INC] dyd_filter_incircle_near: the bound by the permanent. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt.
Open Scope R_scope.

(* C src/skeleton/mesh_filter.c dyd_filter_incircle_near
  double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y, cx = c.x - p.x, cy = c.y - p.y;
  double la = ax * ax + ay * ay, lb = bx * bx + by * by, lc = cx * cx + cy * cy;
  double a1 = bx * cy, a2 = by * cx, b1 = cx * ay, b2 = cy * ax, c1 = ax * by, c2 = ay * bx;
  double d = la * (a1 - a2) + lb * (b1 - b2) + lc * (c1 - c2);
  double e = la * (fabs(a1) + fabs(a2)) + lb * (fabs(b1) + fabs(b2)) + lc * (fabs(c1) + fabs(c2));
  e = 11.05 * 0x1p-53 * e + 0x1p-1060 * (la + lb + lc + 1);
  if (m->incircle_delta > 0) return 0;
  if (d > e) return 1;
  return d < -e ? -1 : 0;
*)
Definition pcross (bx by_ cx cy : double) : double := (fabs (bx * cy) + fabs (by_ * cx))%D.
Definition pterm (ax ay bx by_ cx cy : double) : double := (lift ax ay * pcross bx by_ cx cy)%D.
Definition permanent (ax ay bx by_ cx cy : double) : double :=
  (pterm ax ay bx by_ cx cy + pterm bx by_ cx cy ax ay + pterm cx cy ax ay bx by_)%D.
Definition incircle_near_e (ax ay bx by_ cx cy : double) : double :=
  (lit c_incircle_near * permanent ax ay bx by_ cx cy
   + lit c_incircle_near_tiny * (incircle_s ax ay bx by_ cx cy + lit c_one))%D.
Definition filter_incircle_near (delta ax ay bx by_ cx cy px py : double) : Z :=
  let ax := (ax - px)%D in let ay := (ay - py)%D in
  let bx := (bx - px)%D in let by_ := (by_ - py)%D in
  let cx := (cx - px)%D in let cy := (cy - py)%D in
  if gt delta (lit c_zero) then 0%Z
  else answer (incircle_d ax ay bx by_ cx cy) (incircle_near_e ax ay bx by_ cx cy).

Lemma app_abs k h m x' x : app k h m x' x -> app k h m (Rabs x') (Rabs x).
Proof.
  intros [A B]; split; [now rewrite Rabs_Rabsolu|].
  apply Rle_trans with (2 := B). apply Rabs_triang_inv2.
Qed.

(** Whatever the permanent holds finite is finite in the determinant. *)
Lemma dominated_sub x y X Y : finite (X + Y)%D -> finite x -> finite y -> Rabs (val x) <= val X -> Rabs (val y) <= val
  Y ->
  finite (x - y)%D /\ val (x - y)%D = rnd (val x - val y) /\ Rabs (val (x - y)%D) <= val (X + Y)%D.
Proof.
  intros F Fx Fy Hx Hy. destruct (fadd_inv _ _ F) as (_ & _ & E).
  assert (B : Rabs (rnd (val x - val y)) <= val (X + Y)%D).
  { rewrite E, <- rnd_abs. apply rnd_le. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp; lra. }
  destruct (fsub_finite x y Fx Fy) as [G G'].
  - generalize (val_lt_max (X + Y)%D) (Rle_abs (val (X + Y)%D)); lra.
  - now rewrite G'.
Qed.
Lemma dominated_add x y X Y : finite (X + Y)%D -> finite x -> finite y -> Rabs (val x) <= val X -> Rabs (val y) <= val
  Y ->
  finite (x + y)%D /\ val (x + y)%D = rnd (val x + val y) /\ Rabs (val (x + y)%D) <= val (X + Y)%D.
Proof.
  intros F Fx Fy Hx Hy. destruct (fadd_inv _ _ F) as (_ & _ & E).
  assert (B : Rabs (rnd (val x + val y)) <= val (X + Y)%D).
  { rewrite E, <- rnd_abs. apply rnd_le. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  destruct (fadd_finite x y Fx Fy) as [G G'].
  - generalize (val_lt_max (X + Y)%D) (Rle_abs (val (X + Y)%D)); lra.
  - now rewrite G'.
Qed.
Lemma dominated_mul x y X Y : finite (X * Y)%D -> finite x -> finite y -> Rabs (val x) <= val X -> Rabs (val y) <= val
  Y ->
  finite (x * y)%D /\ val (x * y)%D = rnd (val x * val y) /\ Rabs (val (x * y)%D) <= val (X * Y)%D.
Proof.
  intros F Fx Fy Hx Hy. destruct (fmul_inv _ _ F) as (_ & _ & E).
  assert (B : Rabs (rnd (val x * val y)) <= val (X * Y)%D).
  { rewrite E, <- rnd_abs. apply rnd_le. rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; assumption. }
  destruct (fmul_finite x y Fx Fy) as [G G'].
  - generalize (val_lt_max (X * Y)%D) (Rle_abs (val (X * Y)%D)); lra.
  - now rewrite G'.
Qed.

Lemma pterm_dominates ax ay bx by_ cx cy : finite (pterm ax ay bx by_ cx cy) ->
  finite (lift ax ay) /\ finite (cross bx by_ cx cy) /\ finite (term ax ay bx by_ cx cy) /\
  val (term ax ay bx by_ cx cy) = rnd (val (lift ax ay) * val (cross bx by_ cx cy)) /\
  Rabs (val (term ax ay bx by_ cx cy)) <= val (pterm ax ay bx by_ cx cy).
Proof.
  intros F. unfold pterm in *. destruct (fmul_inv _ _ F) as (Fl & Fp & _). unfold pcross in Fp.
  destruct (fadd_inv _ _ Fp) as (F1 & F2 & _). rewrite fabs_finite in F1, F2.
  destruct (dominated_sub (bx * cy)%D (by_ * cx)%D _ _ Fp F1 F2) as (Fc & _ & Bc); [rewrite fabs_val; lra..|].
  split; [exact Fl|split; [exact Fc|]].
  apply (dominated_mul _ _ _ _ F Fl Fc); [|exact Bc].
  rewrite Rabs_pos_eq; [lra|]. now apply lift_nonneg.
Qed.

Lemma pterm_app ax ay bx by_ cx cy AX AY BX BY CX CY : diff ax AX -> diff ay AY -> diff bx BX -> diff by_ BY ->
  diff cx CX -> diff cy CY -> finite (pterm ax ay bx by_ cx cy) ->
  app 9 (hterm (Lift AX AY) (Mcross BX BY CX CY)) (Lift AX AY * Mcross BX BY CX CY)
    (val (pterm ax ay bx by_ cx cy)) (Lift AX AY * Mcross BX BY CX CY).
Proof.
  intros D1 D2 D3 D4 D5 D6 F. unfold pterm in *. destruct (fmul_inv _ _ F) as (Fl & Fp & E). rewrite E.
  unfold pcross in *. destruct (fadd_inv _ _ Fp) as (F1 & F2 & E1). rewrite E1, !fabs_val.
  rewrite fabs_finite in F1, F2. destruct (fmul_inv _ _ F1) as (_ & _ & E2). destruct (fmul_inv _ _ F2) as (_ & _ & E3).
  rewrite E2, E3. generalize eta_pos; intros P.
  assert (H4 : 0 <= h4) by (unfold h4, u; lra).
  eapply app_weaken; [apply (app_mul 4 4 h4 h4 (Lift AX AY) (Mcross BX BY CX CY));
    [exact H4|exact H4|now apply lift_app|]|lia| |lra].
  - rewrite <- !rnd_abs. unfold Mcross. rewrite <- (Rabs_mult BX CY), <- (Rabs_mult BY CX).
    apply app_add; [apply rnd_format|apply rnd_format| |].
    + rewrite rnd_abs. apply app_abs. rewrite Rabs_mult. now apply (app_mul0 1 1).
    + rewrite rnd_abs. apply app_abs. rewrite Rabs_mult. now apply (app_mul0 1 1).
  - apply hterm_bound; [apply Lift_pos|apply Mcross_pos].
Qed.

Theorem filter_incircle_near_correct delta ax ay bx by_ cx cy px py : finite delta -> 0 <= val delta ->
  let sign := filter_incircle_near delta ax ay bx by_ cx cy px py in
  let det := incircle (val ax) (val ay) (val bx) (val by_) (val cx) (val cy) (val px) (val py) in
  (sign <> 0%Z -> val delta = 0) /\ (sign = 1%Z -> 0 < det) /\ (sign = (-1)%Z -> det < 0).
Proof.
  intros Fd Pd sign det. destruct (lit_correct c_zero eq_refl) as [Fz Vz].
  assert (Z0 : cval c_zero = 0) by (unfold cval; simpl; lra).
  unfold sign, filter_incircle_near. cbv zeta.
  generalize (gt_finite delta (lit c_zero) Fd Fz); rewrite Vz, Z0.
  destruct (gt delta (lit c_zero)); [now split|]. intros [_ I].
  split; [intros _; destruct (Rle_or_lt (val delta) 0) as [L|L]; [lra|discriminate (I L)]|].
  set (e := incircle_near_e _ _ _ _ _ _). set (d := incircle_d _ _ _ _ _ _).
  assert (Ne : nneg e).
  { unfold e, incircle_near_e, permanent, pterm, pcross, incircle_s, lift.
    repeat first [apply nneg_add | apply nneg_sqr | apply nneg_abs | apply nneg_lit | apply nneg_mul];
      try reflexivity; simpl; lia. }
  enough (G : finite e -> (gt d e = true -> 0 < det) /\ (lt d (- e) = true -> det < 0)).
  { now apply answer_correct; [exact Ne|intros F; apply G..]. }
  clear sign I Ne. intros Fe. generalize eta_pos; intros EP.
  pose proof Fe as Fe'. unfold e, incircle_near_e in Fe'. destruct (fadd_inv _ _ Fe') as (F1 & F2 & E1).
  destruct (fmul_inv _ _ F1) as (_ & Fp & E2). destruct (fmul_inv _ _ F2) as (_ & Fs1 & E3).
  destruct (fadd_inv _ _ Fs1) as (Fs & _ & E4).
  pose proof Fp as Fp'. unfold permanent in Fp'. destruct (fadd_inv _ _ Fp') as (Fpab & Fpc & E5).
  destruct (fadd_inv _ _ Fpab) as (Fpa & Fpb & E6).
  destruct (pterm_dominates _ _ _ _ _ _ Fpa) as (Fla & Xa & Fta & Eta & Ba).
  destruct (pterm_dominates _ _ _ _ _ _ Fpb) as (Flb & Xb & Ftb & Etb & Bb).
  destruct (pterm_dominates _ _ _ _ _ _ Fpc) as (Flc & Xc & Ftc & Etc & Bc).
  destruct (dominated_add _ _ _ _ Fpab Fta Ftb Ba Bb) as (Ftab & Etab & _).
  destruct (fadd_inv _ _ Fla) as (M1 & M2 & _). destruct (fadd_inv _ _ Flb) as (M3 & M4 & _).
  destruct (fadd_inv _ _ Flc) as (M5 & M6 & _).
  pose proof (diff_sub _ _ (proj1 (fmul_inv _ _ M1))) as D1. pose proof (diff_sub _ _ (proj1 (fmul_inv _ _ M2))) as D2.
  pose proof (diff_sub _ _ (proj1 (fmul_inv _ _ M3))) as D3. pose proof (diff_sub _ _ (proj1 (fmul_inv _ _ M4))) as D4.
  pose proof (diff_sub _ _ (proj1 (fmul_inv _ _ M5))) as D5. pose proof (diff_sub _ _ (proj1 (fmul_inv _ _ M6))) as D6.
  clear M1 M2 M3 M4 M5 M6.
  pose proof (incircle_s_error _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fs) as ES. cbv zeta in ES.
  pose proof (term_app _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fla Xa) as Ta.
  pose proof (term_app _ _ _ _ _ _ _ _ _ _ _ _ D3 D4 D5 D6 D1 D2 Flb Xb) as Tb.
  pose proof (term_app _ _ _ _ _ _ _ _ _ _ _ _ D5 D6 D1 D2 D3 D4 Flc Xc) as Tc.
  pose proof (pterm_app _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fpa) as Pa.
  pose proof (pterm_app _ _ _ _ _ _ _ _ _ _ _ _ D3 D4 D5 D6 D1 D2 Fpb) as Pb.
  pose proof (pterm_app _ _ _ _ _ _ _ _ _ _ _ _ D5 D6 D1 D2 D3 D4 Fpc) as Pc.
  set (AX := val ax - val px) in *. set (AY := val ay - val py) in *. set (BX := val bx - val px) in *.
  set (BY := val by_ - val py) in *. set (CX := val cx - val px) in *. set (CY := val cy - val py) in *.
  rewrite <- Eta in Ta; rewrite <- Etb in Tb; rewrite <- Etc in Tc.
  pose proof (Lift_pos AX AY) as PA. pose proof (Lift_pos BX BY) as PB. pose proof (Lift_pos CX CY) as PC.
  pose proof (Mcross_pos BX BY CX CY) as QA. pose proof (Mcross_pos CX CY AX AY) as QB.
  pose proof (Mcross_pos AX AY BX BY) as QC.
  pose proof (Mcross_le BX BY CX CY) as RA. pose proof (Mcross_le CX CY AX AY) as RB.
  pose proof (Mcross_le AX AY BX BY) as RC.
  pose proof (sum_app _ _ _ _ _ _ _ _ _ _ _ _ (val_format _) (val_format _) (val_format _) PA QA PB QB PC QC Ta Tb Tc)
    as Err.
  pose proof (sum_app _ _ _ _ _ _ _ _ _ _ _ _ (val_format _) (val_format _) (val_format _) PA QA PB QB PC QC Pa Pb Pc)
    as Err2.
  rewrite <- Etab in Err. rewrite <- E6, <- E5 in Err2.
  set (p := Lift AX AY * Mcross BX BY CX CY + Lift BX BY * Mcross CX CY AX AY + Lift CX CY * Mcross AX AY BX BY) in *.
  assert (Pp : 0 <= p) by (unfold p; repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; assumption).
  set (S := Lift AX AY + Lift BX BY + Lift CX CY) in *.
  assert (PS : 0 <= S) by (unfold S; lra). assert (eS : 0 <= eta * S) by (apply Rmult_le_pos; lra).
  assert (H : 22 / 10 * eta * (Lift AX AY + Mcross BX BY CX CY + Lift BX BY + Mcross CX CY AX AY + Lift CX CY + Mcross
    AX AY BX BY)
     <= 22 / 10 * eta * (2 * S)) by (apply Rmult_le_compat_l; [lra|unfold S; lra]).
  change (Lift AX AY * (BX * CY - BY * CX) + Lift BX BY * (CX * AY - CY * AX) + Lift CX CY * (AX * BY - AY * BX)) with
    det in Err.
  rewrite E2, E3, E4 in E1. lits E1.
  set (q0 := val (permanent (ax - px) (ay - py) (bx - px) (by_ - py) (cx - px) (cy - py))) in *.
  set (s := val (incircle_s (ax - px) (ay - py) (bx - px) (by_ - py) (cx - px) (cy - py))) in *.
  change (val (pterm (ax - px) (ay - py) (bx - px) (by_ - py) (cx - px) (cy - py) +
     pterm (bx - px) (by_ - py) (cx - px) (cy - py) (ax - px) (ay - py) +
     pterm (cx - px) (cy - py) (ax - px) (ay - py) (bx - px) (by_ - py))%D) with q0 in Err2.
  assert (Pq0 : 0 <= q0).
  { apply nneg_val. unfold permanent, pterm, pcross, lift.
    repeat first [apply nneg_add | apply nneg_sqr | apply nneg_abs | apply nneg_mul]. }
  assert (Ps : 0 <= s) by (apply nneg_val; unfold incircle_s, lift; repeat first [apply nneg_add | apply nneg_sqr]).
  assert (C : 110499 / 10000 * u <= cval c_incircle_near <= 12 * u) by (unfold c_incircle_near, u; split; numerals;
    lra).
  assert (C1 : cval c_one = 1) by (unfold c_one; numerals; lra). rewrite C1 in E1.
  assert (T : cval c_incircle_near_tiny = 32768 * eta).
  { unfold c_incircle_near_tiny, cval, fst, snd. rewrite bpow_eta; simpl (-1060 + 1075)%Z; numerals; ring. }
  rewrite T in E1.
  set (q1 := rnd (cval c_incircle_near * q0)) in *.
  assert (Q1 : cval c_incircle_near * q0 * (1 - u) - eta <= q1) by (apply rnd_lower, Rmult_le_pos; unfold u in C; lra).
  assert (Q1' : 0 <= q1) by (apply rnd_pos, Rmult_le_pos; unfold u in C; lra).
  assert (F1' : format 1) by (rewrite <- C1, <- (proj2 (lit_correct c_one eq_refl)); apply val_format).
  assert (S1 : (s + 1) * (1 - u) <= rnd (s + 1)) by (apply rnd_add_lower; [apply val_format|exact F1'|lra]).
  assert (S1' : 0 <= rnd (s + 1)) by (apply rnd_pos; lra).
  set (q2 := rnd (32768 * eta * rnd (s + 1))) in *.
  assert (Q2 : 32768 * eta * rnd (s + 1) * (1 - u) - eta <= q2) by (apply rnd_lower, Rmult_le_pos; lra).
  assert (Q2' : 0 <= q2) by (apply rnd_pos, Rmult_le_pos; lra).
  assert (Q3 : (q1 + q2) * (1 - u) <= rnd (q1 + q2)) by (apply rnd_add_lower; try apply rnd_format; lra).
  assert (K1 : 110499 / 10000 * u * q0 <= cval c_incircle_near * q0) by (apply Rmult_le_compat_r; lra).
  assert (K2 : 32768 * eta * ((s + 1) * (1 - u)) <= 32768 * eta * rnd (s + 1)) by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in Err2. apply Rabs_le_inv in ES.
  assert (K3 : p * (1 - 11002 / 1000 * u) - 5 * (eta * S) - 7 * eta <= q0) by (unfold u in *; lra).
  assert (K4 : 11049 / 1000 * u * p - (eta * S) - eta - eta <= q1) by (clear - Q1 K1 K3 Pp eS EP; unfold u in *; lra).
  assert (K5 : 30000 * (eta * S) + 30000 * eta <= q2).
  { assert (Se : S * (1 - 601 / 100 * u) - 7 * eta <= s) by lra.
    assert (32768 * eta * (S * (1 - 601 / 100 * u) - 7 * eta) <= 32768 * eta * s) by (apply Rmult_le_compat_l; lra).
    generalize eta_small; intros SM. pose proof eta2.
    clear - K2 Q2 H0 H1 eS EP. unfold u in *. lra. }
  destruct (conclude _ _ det _ 0 (val e) Err) as [Pos Neg].
  { rewrite Rminus_eq_0, Rabs_R0; lra. }
  { unfold e, incircle_near_e; rewrite E1. apply Rlt_le_trans with (2 := Q3).
    clear - H K4 K5 Pp eS EP. unfold u in *. lra. }
  split; intros G.
  - apply Pos, (fadd_gt _ _ _ Ftab Ftc Fe G).
  - apply Neg. rewrite <- fopp_val. apply (fadd_lt _ _ _ Ftab Ftc); [now rewrite fopp_finite|exact G].
Qed.
