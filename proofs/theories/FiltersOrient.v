(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-ORI] Orientation of representatives in doubles: a nonzero answer is the sign of the exact determinant. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core.
From Dyadel Require Import FiltersBase FiltersError FiltersConst.
Open Scope R_scope.

(* C src/skeleton/mesh_filter.h dyd_filter_orient_bound
  double e = extent_x > extent_y ? extent_x : extent_y;
  return extent_x * extent_y * 1.01e-15 + 10 * delta * (e + 4 * delta) + 0x1p-1000;
*)
Definition orient_bound (extent_x extent_y delta : double) : double :=
  let e := if gt extent_x extent_y then extent_x else extent_y in
  (extent_x * extent_y * lit c_orient_bound + lit c_orient_delta * delta * (e + lit c_orient_delta2 * delta)
   + lit c_orient_tiny)%D.

(* C src/skeleton/mesh_filter.h dyd_filter_turn
  if (d > m->orient_bound) return 1;
  return d < -m->orient_bound ? -1 : 0;
*)
(* C src/skeleton/mesh_filter.h dyd_filter_orient
  return dyd_filter_turn(m, dyd_seen_cross(dyd_see(a, p), dyd_see(b, p)));
*)
Definition orient_d (ax ay bx by_ px py : double) : double :=
  ((ax - px) * (by_ - py) - (ay - py) * (bx - px))%D.
Definition filter_orient (bound ax ay bx by_ px py : double) : Z :=
  answer (orient_d ax ay bx by_ px py) bound.

(** det(a - p, b - p) *)
Definition orient (ax ay bx by_ px py : R) : R := (ax - px) * (by_ - py) - (ay - py) * (bx - px).

(** ** Rounding, without overflow *)

Lemma pow4 : (1 + u) ^ 4 - 1 <= 4.001 * u.
Proof. unfold u; lra. Qed.

Lemma format_double x : format x -> format (2 * x).
Proof.
  intros F. apply generic_format_FLT. apply FLT_format_generic in F; [|typeclasses eauto].
  destruct F as [[m e] -> M E]; simpl in *. exists (Float radix2 m (e + 1)); simpl; [|exact M|lia].
  unfold F2R, Fnum, Fexp. rewrite bpow_plus; change (bpow radix2 1) with 2; ring.
Qed.

(** The four differences and two products of the determinant. *)
Lemma orient_error ax ay bx by_ px py :
  format ax -> format ay -> format bx -> format by_ -> format px -> format py ->
  let left := rnd (rnd (ax - px) * rnd (by_ - py)) in
  let right := rnd (rnd (ay - py) * rnd (bx - px)) in
  app 3 eta (Rabs (ax - px) * Rabs (by_ - py)) left ((ax - px) * (by_ - py)) /\
  app 3 eta (Rabs (ay - py) * Rabs (bx - px)) right ((ay - py) * (bx - px)) /\
  Rabs (rnd (left - right) - orient ax ay bx by_ px py) <=
    4.001 * u * (Rabs (ax - px) * Rabs (by_ - py) + Rabs (ay - py) * Rabs (bx - px)) + 3 * eta.
Proof.
  intros F1 F2 F3 F4 F5 F6 left right.
  assert (L : app 3 eta (Rabs (ax - px) * Rabs (by_ - py)) left ((ax - px) * (by_ - py)))
    by (apply (app_mul0 1 1); now apply app_diff).
  assert (R : app 3 eta (Rabs (ay - py) * Rabs (bx - px)) right ((ay - py) * (bx - px)))
    by (apply (app_mul0 1 1); now apply app_diff).
  split; [exact L|split; [exact R|]].
  assert (S : app 4 ((1 + u) * (eta + eta)) (Rabs (ax - px) * Rabs (by_ - py) + Rabs (ay - py) * Rabs (bx - px))
    (rnd (left - right)) ((ax - px) * (by_ - py) - (ay - py) * (bx - px)))
    by (apply app_sub; [unfold left; auto|unfold right; auto|exact L|exact R]).
  pose proof (app_m_pos _ _ _ _ _ S) as M. destruct S as [_ S]. unfold orient.
  apply Rle_trans with (1 := S). generalize pow4 eta_pos; intros P E.
  apply Rplus_le_compat; [apply Rmult_le_compat_r; assumption|unfold u; lra].
Qed.

(** Moving the points by at most delta. *)
Lemma orient_moved ax ay bx by_ px py ax' ay' bx' by_' px' py' delta e : 0 <= delta ->
  Rabs (ax' - ax) <= delta -> Rabs (ay' - ay) <= delta -> Rabs (bx' - bx) <= delta ->
  Rabs (by_' - by_) <= delta -> Rabs (px' - px) <= delta -> Rabs (py' - py) <= delta ->
  Rabs (ax - px) <= e -> Rabs (ay - py) <= e -> Rabs (bx - px) <= e -> Rabs (by_ - py) <= e ->
  Rabs (orient ax' ay' bx' by_' px' py' - orient ax ay bx by_ px py) <= 8 * delta * (e + delta).
Proof.
  intros D H1 H2 H3 H4 H5 H6 B1 B2 B3 B4. unfold orient.
  assert (W : forall x y x' y', Rabs (x' - x) <= delta -> Rabs (y' - y) <= delta ->
    Rabs ((x' - y') - (x - y)) <= 2 * delta).
  { intros x y x' y' X Y. replace (x' - y' - (x - y)) with ((x' - x) - (y' - y)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp; lra. }
  assert (P : forall s t s' t', Rabs (s' - s) <= 2 * delta -> Rabs (t' - t) <= 2 * delta -> Rabs s <= e -> Rabs t <= e
    ->
    Rabs (s' * t' - s * t) <= 4 * delta * (e + delta)).
  { intros s t s' t' S T Bs Bt.
    replace (s' * t' - s * t) with (s * (t' - t) + ((s' - s) * t + (s' - s) * (t' - t))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _).
    apply Rle_trans with (Rabs (s * (t' - t)) + (Rabs ((s' - s) * t) + Rabs ((s' - s) * (t' - t)))).
    { apply Rplus_le_compat_l, Rabs_triang. }
    rewrite !Rabs_mult.
    assert (Rabs s * Rabs (t' - t) <= e * (2 * delta)) by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    assert (Rabs (s' - s) * Rabs t <= 2 * delta * e) by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    assert (Rabs (s' - s) * Rabs (t' - t) <= 2 * delta * (2 * delta))
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    nra. }
  pose proof (P _ _ _ _ (W _ _ _ _ H1 H5) (W _ _ _ _ H4 H6) B1 B4) as P1.
  pose proof (P _ _ _ _ (W _ _ _ _ H2 H6) (W _ _ _ _ H3 H5) B2 B3) as P2.
  match goal with |- Rabs (?a - ?b - (?c - ?d)) <= _ => replace (a - b - (c - d)) with ((a - c) - (b - d)) by ring end.
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. nra.
Qed.

(** The bound in real numbers: what rounding leaves of it. *)
Lemma orient_bound_lower X Y E delta : format X -> format Y -> format E -> format delta ->
  0 <= X -> 0 <= Y -> X <= E -> Y <= E -> 0 <= delta ->
  8.03 * u * (X * Y) + 8 * delta * (E * (1 + 2 * u) + delta) + 1000 * eta <=
  rnd (rnd (rnd (rnd (X * Y) * cval c_orient_bound) +
            rnd (rnd (cval c_orient_delta * delta) * rnd (E + rnd (cval c_orient_delta2 * delta)))) + cval
              c_orient_tiny).
Proof.
  intros FX FY FE FD PX PY XE YE PD.
  assert (XY : 0 <= X * Y) by now apply Rmult_le_pos.
  assert (PE : 0 <= E) by lra.
  generalize eta_pos u_pos; intros eta0 u0.
  assert (C : 1009 / 1000 / 10 ^ 15 <= cval c_orient_bound) by (unfold c_orient_bound; numerals; lra).
  assert (C' : cval c_orient_bound <= 1) by (unfold c_orient_bound; numerals; lra).
  assert (T : cval c_orient_tiny = 37778931862957161709568 * eta).
  { unfold c_orient_tiny, cval, fst, snd. rewrite bpow_eta; simpl (-1000 + 1075)%Z; numerals; ring. }
  assert (FT : format (cval c_orient_tiny)).
  { rewrite <- (proj2 (lit_correct c_orient_tiny eq_refl)); auto. }
  set (q1 := rnd (X * Y)).
  assert (Q1 : X * Y * (1 - u) - eta <= q1) by (apply rnd_lower; exact XY).
  assert (Q1' : 0 <= q1) by now apply rnd_pos.
  set (q2 := rnd (q1 * cval c_orient_bound)).
  assert (Q2 : q1 * cval c_orient_bound * (1 - u) - eta <= q2) by (apply rnd_lower, Rmult_le_pos; lra).
  assert (T10 : 10 * delta * (1 - u) <= rnd (cval c_orient_delta * delta)).
  { replace (cval c_orient_delta * delta) with (2 * (2 * (2 * delta)) + 2 * delta) by (unfold c_orient_delta;
    numerals; ring).
    apply Rle_trans with ((2 * (2 * (2 * delta)) + 2 * delta) * (1 - u)); [right; ring|].
    apply rnd_add_lower; [|now apply format_double|lra]. now repeat apply format_double. }
  assert (T4 : rnd (cval c_orient_delta2 * delta) = 4 * delta).
  { replace (cval c_orient_delta2 * delta) with (2 * (2 * delta)) by (unfold c_orient_delta2; numerals; ring).
    rewrite rnd_id by now repeat apply format_double. ring. }
  rewrite T4.
  assert (F4 : format (4 * delta)) by (rewrite <- T4; auto).
  assert (S4 : (E + 4 * delta) * (1 - u) <= rnd (E + 4 * delta)) by (apply rnd_add_lower; auto; lra).
  set (w := rnd (cval c_orient_delta * delta) * rnd (E + 4 * delta)).
  assert (W : 10 * delta * (1 - u) * ((E + 4 * delta) * (1 - u)) <= w).
  { unfold w; apply Rmult_le_compat; try assumption; apply Rmult_le_pos; unfold u; lra. }
  assert (W' : 0 <= 10 * delta * (1 - u) * ((E + 4 * delta) * (1 - u)))
    by (repeat apply Rmult_le_pos; unfold u; lra).
  set (q3 := rnd w).
  assert (Q3 : w * (1 - u) - eta <= q3) by (apply rnd_lower; lra).
  assert (Q23 : 0 <= q2 /\ 0 <= q3) by (split; apply rnd_pos; [apply Rmult_le_pos|]; lra).
  set (q4 := rnd (q2 + q3)).
  assert (Q4 : (q2 + q3) * (1 - u) <= q4) by (apply rnd_add_lower; unfold q2, q3; auto; fold q2 q3; lra).
  assert (Q5 : (q4 + cval c_orient_tiny) * (1 - u) <= rnd (q4 + cval c_orient_tiny)).
  { apply rnd_add_lower; auto; [unfold q4; auto|]. rewrite T; unfold u in *; nra. }
  apply Rle_trans with (2 := Q5). rewrite T.
  assert (A1 : X * Y * (1008 / 1000 / 10 ^ 15) - 3 * eta <= q2).
  { apply Rle_trans with (2 := Q2).
    assert (K1 : (X * Y * (1 - u) - eta) * cval c_orient_bound <= q1 * cval c_orient_bound) by (apply
      Rmult_le_compat_r; lra).
    assert (K2 : X * Y * (1 - u) * (1009 / 1000 / 10 ^ 15) <= X * Y * (1 - u) * cval c_orient_bound)
      by (apply Rmult_le_compat_l; [apply Rmult_le_pos; unfold u; lra|exact C]).
    assert (K3 : eta * cval c_orient_bound <= eta * 1) by (apply Rmult_le_compat_l; lra).
    unfold u in *; nra. }
  assert (DE : 0 <= delta * E) by now apply Rmult_le_pos.
  assert (DD : 0 <= delta * delta) by now apply Rmult_le_pos.
  assert (A2 : 9.9 * (delta * E) + 39 * (delta * delta) - eta <= q3).
  { unfold u in *; nra. }
  unfold u in *; nra.
Qed.

(** ** The theorem *)

Lemma orient_bound_nneg X Y delta : nneg X -> nneg Y -> nneg delta -> nneg (orient_bound X Y delta).
Proof.
  intros; unfold orient_bound.
  assert (nneg (if gt X Y then X else Y)) by (destruct (gt X Y); assumption).
  repeat first [apply nneg_add | apply nneg_mul | apply nneg_lit]; try assumption; try reflexivity; simpl; lia.
Qed.

Lemma nneg_sub x y : finite x -> finite y -> val y <= val x -> nneg (x - y).
Proof.
  intros Fx Fy H. assert (0 <= rnd (val x - val y)) by (apply rnd_ge_0; lra).
  destruct (fsub_total x y Fx Fy) as [[F E]|[[E _]|[_ A]]].
  - apply nneg_of_val; [exact F|now rewrite E].
  - now rewrite E.
  - exfalso; generalize (bpow_gt_0 radix2 1024); lra.
Qed.

(** Doubles inside [lo, hi]: their difference is at most the extent. *)
Lemma difference_in_extent lo hi x p : finite lo -> finite hi -> finite x -> finite p -> finite (hi - lo)%D ->
  val lo <= val x <= val hi -> val lo <= val p <= val hi ->
  finite (x - p)%D /\ val (x - p)%D = rnd (val x - val p) /\ Rabs (rnd (val x - val p)) <= val (hi - lo)%D /\
  Rabs (val x - val p) <= val hi - val lo.
Proof.
  intros Fl Fh Fx Fp F Hx Hp. destruct (fsub_inv _ _ F) as (_ & _ & E).
  assert (B : Rabs (val x - val p) <= val hi - val lo) by (apply Rabs_le; lra).
  assert (B' : Rabs (rnd (val x - val p)) <= val (hi - lo)%D).
  { rewrite E, <- rnd_abs; now apply rnd_le. }
  destruct (fsub_finite x p Fx Fp) as [G G'].
  { generalize (val_lt_max (hi - lo)%D) (Rle_abs (val (hi - lo)%D)); lra. }
  now repeat split.
Qed.

Lemma product_in_extents x y X Y : finite x -> finite y -> finite (X * Y)%D -> Rabs (val x) <= val X ->
  Rabs (val y) <= val Y -> finite (x * y)%D /\ val (x * y)%D = rnd (val x * val y).
Proof.
  intros Fx Fy F Bx By. destruct (fmul_inv _ _ F) as (_ & _ & E). apply fmul_finite; try assumption.
  apply Rle_lt_trans with (val (X * Y)%D).
  - rewrite E, <- rnd_abs; apply rnd_le; rewrite Rabs_mult.
    apply Rmult_le_compat; try apply Rabs_pos; assumption.
  - generalize (val_lt_max (X * Y)%D) (Rle_abs (val (X * Y)%D)); lra.
Qed.

Section Mesh.
(** All doubles lie in [lox, hix] x [loy, hiy]; the exact representatives within delta of them. *)
Variables lox hix loy hiy delta : double.
Variables (Flox : finite lox) (Fhix : finite hix) (Floy : finite loy) (Fhiy : finite hiy) (Fdelta : finite delta).
Variables (Ox : val lox <= val hix) (Oy : val loy <= val hiy) (Pdelta : 0 <= val delta).
Definition in_box x y :=
  finite x /\ finite y /\ val lox <= val x <= val hix /\ val loy <= val y <= val hiy.
Definition close (x : double) (x' : R) := Rabs (x' - val x) <= val delta.

Theorem filter_orient_correct ax ay bx by_ px py ax' ay' bx' by_' px' py' :
  in_box ax ay -> in_box bx by_ -> in_box px py ->
  close ax ax' -> close ay ay' -> close bx bx' -> close by_ by_' -> close px px' -> close py py' ->
  let sign := filter_orient (orient_bound (hix - lox) (hiy - loy) delta) ax ay bx by_ px py in
  (sign = 1%Z -> 0 < orient ax' ay' bx' by_' px' py') /\ (sign = (-1)%Z -> orient ax' ay' bx' by_' px' py' < 0).
Proof.
  intros (Fax & Fay & Bax & Bay) (Fbx & Fby & Bbx & Bby) (Fpx & Fpy & Bpx & Bpy) Cax Cay Cbx Cby Cpx Cpy sign.
  set (X := (hix - lox)%D) in *. set (Y := (hiy - loy)%D) in *.
  set (e := orient_bound X Y delta) in *.
  assert (Ne : nneg e) by (apply orient_bound_nneg; [apply nneg_sub..|apply nneg_of_val]; assumption).
  set (d := orient_d ax ay bx by_ px py) in *.
  enough (G : finite e -> (gt d e = true -> 0 < orient ax' ay' bx' by_' px' py') /\
                          (lt d (- e) = true -> orient ax' ay' bx' by_' px' py' < 0)).
  { now apply answer_correct; [exact Ne|intros F; apply G..]. }
  intros Fe.
  destruct (fadd_inv _ _ Fe) as (F1 & _ & E1). destruct (fadd_inv _ _ F1) as (F2 & F3 & E2).
  destruct (fmul_inv _ _ F2) as (FXY & _ & E3). destruct (fmul_inv _ _ F3) as (F4 & F5 & E4).
  destruct (fmul_inv _ _ F4) as (_ & _ & E5). destruct (fadd_inv _ _ F5) as (FE & F6 & E6).
  destruct (fmul_inv _ _ F6) as (_ & _ & E7). destruct (fmul_inv _ _ FXY) as (FX & FY & E8).
  destruct (fsub_inv _ _ FX) as (_ & _ & EX). destruct (fsub_inv _ _ FY) as (_ & _ & EY).
  fold X in EX; fold Y in EY.
  set (E := if gt X Y then X else Y) in *.
  assert (ME : val X <= val E /\ val Y <= val E /\ (val E = val X \/ val E = val Y)).
  { unfold E; generalize (gt_finite X Y FX FY); destruct (gt X Y); intros [I J]; [specialize (I eq_refl)|];
      [split; [lra|split; [lra|now left]]|split; [|split; [lra|now right]]].
    destruct (Rle_or_lt (val X) (val Y)) as [L|L]; [exact L|discriminate (J L)]. }
  rewrite E8 in E3. rewrite E3, E4, E5, E6, E7 in E2. lits E2. rewrite E2 in E1. lits E1. fold e in E1.
  assert (PX : 0 <= val X) by (rewrite EX; apply rnd_ge_0; lra).
  assert (PY : 0 <= val Y) by (rewrite EY; apply rnd_ge_0; lra).
  destruct ME as (XE & YE & EE).
  pose proof (orient_bound_lower (val X) (val Y) (val E) (val delta) (val_format _) (val_format _) (val_format _)
    (val_format _) PX PY XE YE Pdelta) as Low.
  rewrite <- E1 in Low.
  destruct (difference_in_extent lox hix ax px Flox Fhix Fax Fpx FX Bax Bpx) as (G1 & V1 & R1 & D1).
  destruct (difference_in_extent loy hiy ay py Floy Fhiy Fay Fpy FY Bay Bpy) as (G2 & V2 & R2 & D2).
  destruct (difference_in_extent lox hix bx px Flox Fhix Fbx Fpx FX Bbx Bpx) as (G3 & V3 & R3 & D3).
  destruct (difference_in_extent loy hiy by_ py Floy Fhiy Fby Fpy FY Bby Bpy) as (G4 & V4 & R4 & D4).
  fold X in R1, R3; fold Y in R2, R4.
  rewrite <- V1 in R1; rewrite <- V2 in R2; rewrite <- V3 in R3; rewrite <- V4 in R4.
  destruct (product_in_extents _ _ X Y G1 G4 FXY R1 R4) as [H1 W1].
  assert (FYX : finite (Y * X)%D /\ val (Y * X)%D = rnd (val Y * val X)).
  { apply fmul_finite; try assumption. rewrite Rmult_comm, <- E8. apply val_lt_max. }
  destruct (product_in_extents _ _ Y X G2 G3 (proj1 FYX) R2 R3) as [H2 W2].
  rewrite V1, V4 in W1; rewrite V2, V3 in W2.
  destruct (orient_error (val ax) (val ay) (val bx) (val by_) (val px) (val py)) as (_ & _ & Err); auto.
  rewrite <- W1, <- W2 in Err.
  set (X0 := val hix - val lox) in *. set (Y0 := val hiy - val loy) in *.
  generalize eta_pos u_pos; intros eta0 u0.
  assert (X0X : X0 * (1 - u) <= val X) by (rewrite EX; apply (rnd_add_lower (val hix) (- val lox)); auto; try lra;
    apply format_opp; auto).
  assert (Y0Y : Y0 * (1 - u) <= val Y) by (rewrite EY; apply (rnd_add_lower (val hiy) (- val loy)); auto; try lra;
    apply format_opp; auto).
  assert (X0X' : X0 <= val X * (1 + 2 * u)) by (unfold u in *; nra).
  assert (Y0Y' : Y0 <= val Y * (1 + 2 * u)) by (unfold u in *; nra).
  assert (P0 : 0 <= X0 /\ 0 <= Y0) by (unfold X0, Y0; lra).
  assert (P1 : Rabs (val ax - val px) * Rabs (val by_ - val py) <= X0 * Y0)
    by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
  assert (P2 : Rabs (val ay - val py) * Rabs (val bx - val px) <= Y0 * X0)
    by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
  assert (P3 : X0 * Y0 <= val X * (1 + 2 * u) * (val Y * (1 + 2 * u))) by (apply Rmult_le_compat; lra).
  assert (Mv : Rabs (orient ax' ay' bx' by_' px' py' - orient (val ax) (val ay) (val bx) (val by_) (val px) (val py))
               <= 8 * val delta * (val E * (1 + 2 * u) + val delta)).
  { apply orient_moved; try assumption; unfold u in *; nra. }
  assert (XY : 0 <= val X * val Y) by now apply Rmult_le_pos.
  assert (U4 : 4.001 * u * (Rabs (val ax - val px) * Rabs (val by_ - val py) +
               Rabs (val ay - val py) * Rabs (val bx - val px)) <= 8.02 * u * (val X * val Y)).
  { apply Rle_trans with (4.001 * u * (2 * (val X * (1 + 2 * u) * (val Y * (1 + 2 * u))))).
    - apply Rmult_le_compat_l; lra.
    - clear - XY; unfold u; nra. }
  destruct (conclude _ _ _ _ _ (val e) Err Mv) as [Pos Neg].
  { apply Rlt_le_trans with (2 := Low). clear - U4 eta0 XY. unfold u in *; lra. }
  split; intros S.
  - apply Pos, (fsub_gt _ _ _ H1 H2 Fe S).
  - apply Neg. rewrite <- fopp_val. apply (fsub_lt _ _ _ H1 H2); [now rewrite fopp_finite|exact S].
Qed.
End Mesh.

(** ** The bound for three points alone *)

(* C src/skeleton/mesh_filter.c dyd_filter_orient_near
  double left = (a.x - p.x) * (b.y - p.y), right = (a.y - p.y) * (b.x - p.x), d = left - right;
  double e = 4.01 * 0x1p-53 * (fabs(left) + fabs(right)) + 0x1p-1000;
  if (m->incircle_delta > 0) return 0;
  if (d > e) return 1;
  return d < -e ? -1 : 0;
*)
Definition orient_near_e (left right : double) : double :=
  (lit c_orient_near * (fabs left + fabs right) + lit c_orient_near_tiny)%D.
Definition filter_orient_near (delta ax ay bx by_ px py : double) : Z :=
  let left := ((ax - px) * (by_ - py))%D in
  let right := ((ay - py) * (bx - px))%D in
  if gt delta (lit c_zero) then 0%Z else answer (left - right) (orient_near_e left right).

Lemma app_lower k h m x' x : app k h m x' x -> Rabs x = m -> m * (2 - (1 + u) ^ k) - h <= Rabs x'.
Proof.
  intros [_ A] B. generalize (Rabs_triang_inv x (x - x')).
  replace (x - (x - x')) with x' by ring. rewrite (Rabs_minus_sym x x'). lra.
Qed.

Theorem filter_orient_near_correct delta ax ay bx by_ px py : finite delta -> 0 <= val delta ->
  let sign := filter_orient_near delta ax ay bx by_ px py in
  let det := orient (val ax) (val ay) (val bx) (val by_) (val px) (val py) in
  (sign <> 0%Z -> val delta = 0) /\ (sign = 1%Z -> 0 < det) /\ (sign = (-1)%Z -> det < 0).
Proof.
  intros Fd Pd sign det. destruct (lit_correct c_zero eq_refl) as [Fz Vz].
  assert (Z0 : cval c_zero = 0) by (unfold cval; simpl; lra).
  unfold sign, filter_orient_near.
  set (left := ((ax - px) * (by_ - py))%D). set (right := ((ay - py) * (bx - px))%D).
  generalize (gt_finite delta (lit c_zero) Fd Fz); rewrite Vz, Z0.
  destruct (gt delta (lit c_zero)); [now split|]. intros [_ I].
  split; [intros _; destruct (Rle_or_lt (val delta) 0) as [L|L]; [lra|discriminate (I L)]|].
  set (e := orient_near_e left right).
  assert (Ne : nneg e).
  { unfold e, orient_near_e. repeat first [apply nneg_add | apply nneg_mul | apply nneg_abs | apply nneg_lit];
      try reflexivity; simpl; lia. }
  enough (G : finite e -> (gt (left - right) e = true -> 0 < det) /\ (lt (left - right) (- e) = true -> det < 0)).
  { now apply answer_correct; [exact Ne|intros F; apply G..]. }
  intros Fe. unfold e, orient_near_e in Fe.
  destruct (fadd_inv _ _ Fe) as (F1 & _ & E1). destruct (fmul_inv _ _ F1) as (_ & F2 & E2).
  destruct (fadd_inv _ _ F2) as (F3 & F4 & E3). rewrite fabs_finite in F3, F4.
  destruct (fmul_inv _ _ F3) as (G1 & G2 & EL). destruct (fmul_inv _ _ F4) as (G3 & G4 & ER).
  destruct (fsub_inv _ _ G1) as (_ & _ & V1). destruct (fsub_inv _ _ G2) as (_ & _ & V2).
  destruct (fsub_inv _ _ G3) as (_ & _ & V3). destruct (fsub_inv _ _ G4) as (_ & _ & V4).
  rewrite V1, V2 in EL; rewrite V3, V4 in ER. fold left in EL, E2, E3, F3, Fe, E1; fold right in ER, E2, E3, F4, Fe, E1.
  rewrite !fabs_val in E3. rewrite E2, E3 in E1. lits E1.
  destruct (orient_error (val ax) (val ay) (val bx) (val by_) (val px) (val py)) as (L & R & Err); try apply val_format.
  fold det in Err. rewrite <- EL in L, Err; rewrite <- ER in R, Err.
  pose proof (app_lower _ _ _ _ _ L (Rabs_mult _ _)) as L1. pose proof (app_lower _ _ _ _ _ R (Rabs_mult _ _)) as R1.
  set (ML := Rabs (val ax - val px) * Rabs (val by_ - val py)) in *.
  set (MR := Rabs (val ay - val py) * Rabs (val bx - val px)) in *.
  assert (PL : 0 <= ML) by (apply Rmult_le_pos; apply Rabs_pos).
  assert (PR : 0 <= MR) by (apply Rmult_le_pos; apply Rabs_pos).
  generalize eta_pos (Rabs_pos (val left)) (Rabs_pos (val right)); intros eta0 AL AR.
  assert (FL : format (Rabs (val left)) /\ format (Rabs (val right))) by (rewrite <- !fabs_val; split;
    apply val_format).
  set (q1 := rnd (Rabs (val left) + Rabs (val right))) in *.
  assert (Q1 : (Rabs (val left) + Rabs (val right)) * (1 - u) <= q1) by (apply rnd_add_lower; [apply FL|apply FL|lra]).
  assert (C : 40099 / 10000 * u <= cval c_orient_near <= 1) by (unfold c_orient_near, u; split; numerals; lra).
  assert (Q1' : 0 <= q1) by (apply rnd_pos; lra).
  set (q2 := rnd (cval c_orient_near * q1)) in *.
  assert (Q2 : cval c_orient_near * q1 * (1 - u) - eta <= q2) by (apply rnd_lower, Rmult_le_pos; unfold u in C; lra).
  assert (Q2' : 0 <= q2) by (apply rnd_pos, Rmult_le_pos; unfold u in C; lra).
  assert (T : cval c_orient_near_tiny = 37778931862957161709568 * eta).
  { unfold c_orient_near_tiny, cval, fst, snd. rewrite bpow_eta; simpl (-1000 + 1075)%Z; numerals; ring. }
  assert (Q3 : (q2 + cval c_orient_near_tiny) * (1 - u) <= rnd (q2 + cval c_orient_near_tiny)).
  { apply rnd_add_lower; [apply rnd_format| |rewrite T; lra].
    rewrite <- (proj2 (lit_correct c_orient_near_tiny eq_refl)); apply val_format. }
  assert (Low : 4.005 * u * (ML + MR) + 1000 * eta <= val e).
  { unfold e, orient_near_e; rewrite E1. apply Rle_trans with (2 := Q3). rewrite T.
    assert (K1 : (ML + MR) * (1 - 4 * u) - 3 * eta <= q1).
    { apply Rle_trans with (2 := Q1). simpl in L1, R1. clear - L1 R1 PL PR eta0. unfold u in *. lra. }
    assert (K2 : 40099 / 10000 * u * q1 <= cval c_orient_near * q1) by (apply Rmult_le_compat_r; lra).
    clear - K1 K2 Q2 eta0 PL PR. unfold u in *. lra. }
  destruct (conclude _ _ det _ 0 (val e) Err) as [Pos Neg].
  { rewrite Rminus_eq_0, Rabs_R0; lra. }
  { apply Rlt_le_trans with (2 := Low). clear - eta0 PL PR. unfold u in *; lra. }
  split; intros S.
  - apply Pos, (fsub_gt _ _ _ F3 F4 Fe S).
  - apply Neg. rewrite <- fopp_val. apply (fsub_lt _ _ _ F3 F4); [now rewrite fopp_finite|exact S].
Qed.
