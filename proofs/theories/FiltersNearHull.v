(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [WIT-HULL] dyd_filter_hull_edge_near in doubles; and the bound m of both filters, from least squares of distances. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt
  FiltersDistance FiltersInterval FiltersNearRound.
From Dyadel Require Import Plane Distance Cells Legal FiltersNearPlane FiltersNearCode.
Open Scope R_scope.

(* [WIT-HULL] src/legal/star_filter.h: double a1 = (jx * uy - jy * ux) - {} * (lj + lu); *)
Definition c_hull_side : const := (4728779608739021, -104)%Z.
(* [WIT-HULL] src/legal/star_filter.h: if (!(a1 >= {} && *)
Definition c_hull_a1 : const := (1, -100)%Z.
(* [WIT-HULL] src/legal/star_filter.h: && lj + lu <= {} && *)
Definition c_hull_most : const := (1, 98)%Z.
(* [WIT-HULL] src/legal/star_filter.h: lj + lu <= 0x1p98 && {} * reach <= m *)
Definition c_hull_ratio : const := (25, 3)%Z.
(* [WIT-HULL] src/legal/star_filter.h: return {} * reach * sqrt(lu * lw) < m * a1; *)
Definition c_hull_k : const := (6839841934068941, -47)%Z.

(* C src/legal/star_filter.h dyd_filter_hull_edge_near
  double jx = j.x - i.x, jy = j.y - i.y, ux = u.x - i.x, uy = u.y - i.y;
  double lj = jx * jx + jy * jy, lu = ux * ux + uy * uy, lw = dyd_square_distance(j, u);
  double a1 = (jx * uy - jy * ux) - 2.1 * 0x1p-53 * (lj + lu);
  if (!(a1 >= 0x1p-100 && lj + lu <= 0x1p98 && 200 * reach <= m)) return false;
  return 48.6 * reach * sqrt(lu * lw) < m * a1;
*)
Definition filter_hull_edge_near (i_x i_y j_x j_y u_x u_y reach m : double) : bool :=
  let jx := (j_x - i_x)%D in let jy := (j_y - i_y)%D in let ux := (u_x - i_x)%D in let uy := (u_y - i_y)%D in
  let lj := lift jx jy in let lu := lift ux uy in let lw := square_distance j_x j_y u_x u_y in
  let a1 := (cross jx jy ux uy - lit c_hull_side * (lj + lu))%D in
  if negb (le (lit c_hull_a1) a1 && le (lj + lu) (lit c_hull_most) && le (lit c_hull_ratio * reach) m) then false
  else lt (lit c_hull_k * reach * fsqrt (lu * lw)) (m * a1).

Lemma sqrt_low x P : 0 <= P -> P * (1 - 13 * u) <= x -> 1 / 10 ^ 91 <= sqrt P -> sqrt P * (1 - 15 * u) <= rnd (sqrt x).
Proof.
  intros HP H L. pose proof eta_323 as E.
  assert (Q : sqrt P * (1 - 13 * u) <= sqrt x).
  { apply Rle_trans with (sqrt (P * (1 - 13 * u))); [|now apply sqrt_le_1_alt].
    rewrite <- (sqrt_square (sqrt P * (1 - 13 * u))) by (apply Rmult_le_pos; unfold u; lra). apply sqrt_le_1_alt.
    replace (sqrt P * (1 - 13 * u) * (sqrt P * (1 - 13 * u))) with (sqrt P * sqrt P * (1 - 13 * u) * (1 - 13 * u)) by ring.
    rewrite sqrt_sqrt by exact HP. assert (0 <= P * (1 - 13 * u)) by (apply Rmult_le_pos; unfold u; lra).
    assert (P * (1 - 13 * u) * (1 - 13 * u) <= P * (1 - 13 * u) * 1) by (apply Rmult_le_compat_l; unfold u in *; lra).
    lra. }
  assert (sqrt x * (1 - u) - eta <= rnd (sqrt x)) by apply rnd_lower, sqrt_pos. unfold u in *; lra.
Qed.

Lemma hull_compared E lu lw LU LW m M x A1 : 4 / 10 ^ 91 <= E ->
  LU * (1 - 5 * u) <= lu -> LW * (1 - 5 * u) <= lw -> 15 / 10 ^ 92 <= LU -> 15 / 10 ^ 92 <= LW ->
  7 / 10 ^ 89 <= m -> m <= M * (1 + / 10 ^ 12) -> 0 <= x <= A1 * (1 + u) -> 39 / 10 ^ 32 <= A1 ->
  rnd (rnd (cval c_hull_k * E) * rnd (sqrt (rnd (lu * lw)))) < rnd (m * x) ->
  4850 / 100 * E * sqrt (LU * LW) < M * A1.
Proof.
  intros LE Hu Hw LLU LLW Lm Hm Hx LA1 C. set (M' := M * (1 + / 10 ^ 12)) in *.
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
  assert (LR : 1 / 10 ^ 91 <= sqrt P).
  { rewrite <- (sqrt_square (1 / 10 ^ 91)) by lra. apply sqrt_le_1_alt. lra. }
  pose proof (sqrt_low _ P ltac:(lra) Q1' LR) as Q2. set (r := sqrt P) in *. set (q := rnd (sqrt _)) in *.
  assert (Q3 : 48599 / 1000 * E * (1 - 2 * u) <= rnd (cval c_hull_k * E)).
  { apply reach_scaled; [unfold c_hull_k; numerals; lra|lra|exact LE]. }
  assert (ER : 4 / 10 ^ 91 * (1 / 10 ^ 91) <= E * r) by (apply below_product; lra).
  assert (L : 48598 / 1000 * (E * r) <= rnd (rnd (cval c_hull_k * E) * q)).
  { apply Rle_trans with (48599 / 1000 * E * (1 - 2 * u) * (r * (1 - 15 * u)) * (1 - 2 * u)).
    - replace (48599 / 1000 * E * (1 - 2 * u) * (r * (1 - 15 * u)) * (1 - 2 * u)) with
        (E * r * (48599 / 1000 * (1 - 2 * u) * (1 - 15 * u) * (1 - 2 * u))) by ring. unfold u; lra.
    - apply mul_low; [unfold u in *; lra|unfold u in *; lra|].
      replace (48599 / 1000 * E * (1 - 2 * u) * (r * (1 - 15 * u))) with
        (E * r * (48599 / 1000 * (1 - 2 * u) * (1 - 15 * u))) by ring. unfold u; lra. }
  assert (LM : 7 / 10 ^ 89 <= M') by lra.
  assert (MA : 7 / 10 ^ 89 * (39 / 10 ^ 32) <= M' * A1) by (apply below_product; lra).
  assert (R : rnd (m * x) <= M' * A1 * (1 + 4 * u)).
  { apply Rle_trans with (M' * (A1 * (1 + u)) * (1 + 2 * u)).
    - apply mul_up; [lra|exact Hx|]. replace (M' * (A1 * (1 + u))) with (M' * A1 * (1 + u)) by ring. unfold u; lra.
    - replace (M' * (A1 * (1 + u)) * (1 + 2 * u)) with (M' * A1 * ((1 + u) * (1 + 2 * u))) by ring.
      apply Rmult_le_compat_l; [lra|unfold u; lra]. }
  replace (M' * A1) with (M * A1 * (1 + / 10 ^ 12)) in * by (unfold M'; ring). unfold u in *. lra.
Qed.

Theorem filter_hull_edge_near_conditions i_x i_y j_x j_y u_x u_y reach m M :
  let i := (val i_x, val i_y) in let j := (val j_x, val j_y) in let u := (val u_x, val u_y) in
  finite reach -> bpow radix2 (-300) <= val reach -> finite m -> val m <= M * (1 + / 10 ^ 12) -> M <= dist i j ->
  filter_hull_edge_near i_x i_y j_x j_y u_x u_y reach m = true ->
  0 < M /\ 199 * val reach <= M /\ 0 < cross_at i j u /\
  4850 / 100 * val reach * sqrt (dist2 u i * dist2 u j) < M * cross_at i j u.
Proof.
  intros i j p Fr Er Fm Hm HM. unfold filter_hull_edge_near. cbv zeta.
  set (jx := (j_x - i_x)%D). set (jy := (j_y - i_y)%D). set (ux := (u_x - i_x)%D). set (uy := (u_y - i_y)%D).
  set (s := (lift jx jy + lift ux uy)%D). set (w := square_distance j_x j_y u_x u_y).
  destruct (_ && _ && _) eqn:G; [|discriminate]. cbn [negb].
  apply andb_prop in G. destruct G as [G G3]. apply andb_prop in G. destruct G as [G1 G2]. intros C.
  pose proof eta_323 as H323. pose proof eta_pos as EP. pose proof least_reach as LR.
  assert (Er' : 4 / 10 ^ 91 <= val reach) by lra.
  destruct (ratio_code c_hull_ratio reach m M eq_refl ltac:(unfold c_hull_ratio; numerals; lra) Fr Er' Fm Hm G3)
    as (Lm & EM & PM).
  assert (Nl : forall x y, nneg (lift x y)) by (intros; unfold lift; apply nneg_add; apply nneg_sqr).
  assert (Ns : nneg s) by (apply nneg_add; apply Nl).
  destruct (lit_correct c_hull_most eq_refl) as [Fl El]. destruct (le_to _ _ Fl Ns G2) as [Fs Hs].
  rewrite El in Hs. replace (cval c_hull_most) with (bpow radix2 98) in Hs by (unfold c_hull_most, cval, fst, snd; ring).
  pose proof most_squares as MS. pose proof (nneg_val _ Ns) as Ps.
  destruct (fadd_inv _ _ Fs) as (Flj & Flu & Vs).
  destruct (fadd_inv _ _ Flj) as (M1 & M2 & _). destruct (fadd_inv _ _ Flu) as (M3 & M4 & _).
  destruct (fmul_inv _ _ M1) as (Fjx & _ & _). destruct (fmul_inv _ _ M2) as (Fjy & _ & _).
  destruct (fmul_inv _ _ M3) as (Fux & _ & _). destruct (fmul_inv _ _ M4) as (Fuy & _ & _).
  pose proof (diff_sub _ _ Fjx) as D1. pose proof (diff_sub _ _ Fjy) as D2. pose proof (diff_sub _ _ Fux) as D3.
  pose proof (diff_sub _ _ Fuy) as D4. fold jx in D1. fold jy in D2. fold ux in D3. fold uy in D4.
  set (JX := val j_x - val i_x) in *. set (JY := val j_y - val i_y) in *. set (UX := val u_x - val i_x) in *.
  set (UY := val u_y - val i_y) in *.
  pose proof (Lift_pos JX JY) as PJ. pose proof (Lift_pos UX UY) as PU. set (S := Lift JX JY + Lift UX UY) in *.
  assert (ES : Rabs (val s - S) <= 601 / 100 * u * S + 7 * eta).
  { unfold s. rewrite Vs.
    pose proof (app_add _ _ _ _ _ _ _ _ _ (val_format _) (val_format _) (lift_app _ _ _ _ D1 D2 Flj)
      (lift_app _ _ _ _ D3 D4 Flu)) as T.
    pose proof (app_m_pos _ _ _ _ _ T) as TM. destruct T as [_ T]. fold S in T, TM. apply Rle_trans with (1 := T).
    assert (((1 + u) ^ 5 - 1) * S <= 601 / 100 * u * S) by (apply Rmult_le_compat_r; [exact TM|unfold u; lra]).
    unfold h4, u in *; lra. }
  assert (HS : S <= 10 ^ 30) by (apply Rabs_le_inv in ES; unfold u in *; lra).
  pose proof V_big as VB.
  assert (Fa1 : finite (cross jx jy ux uy)).
  { apply (cross_finite _ _ _ _ JX JY UX UY S); try assumption; [unfold S; lra|lra]. }
  destruct (cross_side _ _ _ _ _ _ _ _ S D1 D2 D3 D4 Fa1 ltac:(unfold S; lra)) as [E1 B1].
  destruct (side_code _ s c_hull_side c_hull_a1 _ S Fa1 Fs Ps E1 B1 ES HS eq_refl
    ltac:(unfold c_hull_side, u; split; numerals; lra) eq_refl ltac:(unfold c_hull_a1, cval, fst, snd; ring) G1)
    as ((Fx & X) & _ & A1 & LS).
  assert (MB : M <= 10 ^ 30).
  { apply Rle_trans with (1 := HM). apply le_of_squares; [lra|]. rewrite dist_sq.
    replace (dist2 i j) with (Lift JX JY) by (unfold dist2, Lift, JX, JY, i, j; cbn [fst snd]; ring).
    apply Rle_trans with S; [unfold S; lra|lra]. }
  destruct (squares_from_side JX JY UX UY S ltac:(lra) ltac:(unfold S; lra) HS) as [LU LW].
  set (a := (cross jx jy ux uy - lit c_hull_side * s)%D) in *.
  assert (N : nneg (lit c_hull_k * reach * fsqrt (lift ux uy * w))%D).
  { repeat apply nneg_mul; [apply nneg_lit; [reflexivity|simpl; lia]|apply nneg_of_val; [exact Fr|lra]|apply nneg_sqrt]. }
  destruct (lt_from _ _ N C) as [FL _]. destruct (fmul_inv _ _ FL) as (F1 & F2 & E2).
  destruct (fmul_inv _ _ F1) as (_ & _ & E3). destruct (fsqrt_inv _ F2) as (F3 & _ & E4).
  destruct (fmul_inv _ _ F3) as (_ & Fw & E5).
  assert (B2 : 0 <= val m * val a <= 2 * 10 ^ 30 * (2 * 10 ^ 30)).
  { split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; unfold u in *; lra]. }
  destruct (fmul_small m a Fm Fx) as [F6 E6]; [rewrite Rabs_pos_eq; lra|].
  apply lt_finite in C; [|assumption..]. rewrite E2, E3, E4, E5, E6 in C. lits C.
  assert (X1 : cross_at i j p = JX * UY - JY * UX) by reflexivity. assert (QU : dist2 p i = Lift UX UY) by reflexivity.
  assert (QW : dist2 p j = Lift (JX - UX) (JY - UY)) by (unfold dist2, Lift, JX, JY, UX, UY, p, j; cbn [fst snd]; ring).
  rewrite X1, QU, QW. split; [exact PM|]. split; [exact EM|]. split; [lra|].
  apply (hull_compared (val reach) (val (lift ux uy)) (val w) (Lift UX UY) (Lift (JX - UX) (JY - UY)) (val m) M (val a));
    try assumption; try (apply A1).
  - apply (lift_near _ _ UX UY D3 D4 Flu). lra.
  - unfold w, square_distance in *. pose proof Fw as Fw'. unfold lift in Fw'.
    destruct (fadd_inv _ _ Fw') as (N1 & N2 & _). destruct (fmul_inv _ _ N1) as (Gx & _ & _).
    destruct (fmul_inv _ _ N2) as (Gy & _ & _). pose proof (diff_sub _ _ Gx) as Dx. pose proof (diff_sub _ _ Gy) as Dy.
    replace (val j_x - val u_x) with (JX - UX) in Dx by (unfold JX, UX; ring).
    replace (val j_y - val u_y) with (JY - UY) in Dy by (unfold JY, UY; ring).
    apply (lift_near _ _ _ _ Dx Dy Fw). lra.
Qed.

(** All representatives on the left of the edge, none inside the circle. *)
Theorem filter_hull_edge_near_correct N B (x y : nat -> double) i j k c1 reach m M :
  let p q := (val (x q), val (y q)) in
  finite reach -> bpow radix2 (-300) <= val reach -> within N B p (val reach) -> (i < N)%nat -> (j < N)%nat ->
  empty_circle N p c1 i j k -> alone N p M i j -> (forall q, (q < N)%nat -> 0 <= cross_at (p i) (p j) (p q)) ->
  finite m -> val m <= M * (1 + / 10 ^ 12) ->
  filter_hull_edge_near (x i) (y i) (x j) (y j) (x k) (y k) reach m = true ->
  witness N B i j (across (p i) (p j) c1 (dist c1 (p i))).
Proof.
  intros p Fr Er W I J Q1 A Side Fm Hm G.
  destruct (filter_hull_edge_near_conditions _ _ _ _ _ _ reach m M Fr Er Fm Hm (proj1 A) G) as (PM & EM & S1 & C1).
  assert (0 <= val reach) by (generalize (bpow_gt_0 radix2 (-300)); lra).
  now apply (hull_edge_near_legal N B p (val reach) M i j k c1).
Qed.

(** ** The reach and the bound m that dyd_certify_near hands over *)

(* [WIT-NEAR] src/legal/star_filter.c: .reach = reach > {} ? reach *)
(* [WIT-NEAR] src/legal/star_filter.c: ? reach : {}}; *)
Definition c_near_floor : const := (1, -300)%Z.
(* Any positive value will do for the distance that is tried first, dyd_short_edge. *)
Definition near_reach (reach : double) : double := if gt reach (lit c_near_floor) then reach else lit c_near_floor.

Lemma near_reach_correct reach : is_nan 53 1024 reach = false -> finite (near_reach reach) ->
  bpow radix2 (-300) <= val (near_reach reach) /\ (finite reach -> val reach <= val (near_reach reach)).
Proof.
  intros N. destruct (lit_correct c_near_floor eq_refl) as [Fc Vc].
  replace (cval c_near_floor) with (bpow radix2 (-300)) in Vc by (unfold c_near_floor, cval, fst, snd; ring).
  unfold near_reach. destruct (gt reach (lit c_near_floor)) eqn:G; intros F.
  - apply gt_finite in G; [|assumption..]. split; [lra|intros _; lra].
  - split; [lra|]. intros Fr. destruct (Rle_or_lt (val reach) (val (lit c_near_floor))) as [L|L]; [exact L|].
    apply (gt_finite _ _ Fr Fc) in L. congruence.
Qed.


(** A number that is at most 1 - 10^-13 times 2^1024 does not overflow. *)
Lemma below_overflow x : 0 <= x <= bpow radix2 1024 * (1 - / 10 ^ 13) -> Rabs (rnd x) < bpow radix2 1024.
Proof.
  intros H. rewrite Rabs_pos_eq by (apply rnd_pos; lra).
  destruct (lit_correct c_dbl_max eq_refl) as [F V]. apply Rle_lt_trans with (val (lit c_dbl_max)).
  - rewrite <- (rnd_id (val (lit c_dbl_max))) by apply val_format. apply rnd_le. rewrite V.
    unfold c_dbl_max, cval, fst, snd. change 1024%Z with (53 + 971)%Z in H. rewrite bpow_plus in H.
    change (bpow radix2 53) with 9007199254740992 in H. generalize (bpow_gt_0 radix2 971). lra.
  - apply Rle_lt_trans with (1 := Rle_abs _). apply val_lt_max.
Qed.

(** A computed square of a distance that is not less than e bounds the distance by the root of e. *)
Lemma distance_bound ax ay bx by_ e r : finite ax -> finite ay -> finite bx -> finite by_ -> finite e ->
  7 / 10 ^ 89 <= r -> r * r <= val e * (1 + 4 * u) -> lt (square_distance ax ay bx by_) e = false ->
  r <= dist (val ax, val ay) (val bx, val by_) * (1 + / 10 ^ 12).
Proof.
  intros Fax Fay Fbx Fby Fe Lr Re L. set (d := dist _ _).
  destruct (Rle_or_lt r (d * (1 + / 10 ^ 12))) as [K|K]; [exact K|exfalso].
  pose proof eta_323 as H323. pose proof eta_pos as EP.
  assert (Pd : 0 <= d) by apply dist_nonneg.
  assert (Dd : d * d = dist2 (val ax, val ay) (val bx, val by_)) by apply dist_sq.
  unfold dist2 in Dd. cbn [fst snd] in Dd. set (X := val ax - val bx) in *. set (Y := val ay - val by_) in *.
  assert (R0 : 49 / 10 ^ 178 <= val e * (1 + 4 * u)).
  { apply Rle_trans with (2 := Re). assert (7 / 10 ^ 89 * (7 / 10 ^ 89) <= r * r) by (apply Rmult_le_compat; lra). lra. }
  assert (De : d * d <= val e * (1 - 19 / 10 ^ 13)).
  { assert (d * (1 + / 10 ^ 12) * (d * (1 + / 10 ^ 12)) <= r * r) by (apply Rmult_le_compat; lra). unfold u in *. lra. }
  assert (EV : val e < V * V).
  { rewrite <- bpow_plus. apply Rle_lt_trans with (1 := Rle_abs _). apply val_lt_max. }
  assert (XX : 0 <= X * X) by apply Rle_0_sqr. assert (YY : 0 <= Y * Y) by apply Rle_0_sqr.
  pose proof V_big as VB. assert (VV : 10 ^ 100 * V <= V * V) by (apply Rmult_le_compat_r; lra).
  assert (small : forall z, z * z <= V * V -> Rabs z <= V * V / 2).
  { intros z Hz. apply Rle_trans with V; [apply abs_of_sqr; lra|lra]. }
  destruct (fsub_finite ax bx Fax Fbx) as [F1 E1]; [apply rnd_below_max, small; fold X; unfold u in *; lra|].
  destruct (fsub_finite ay by_ Fay Fby) as [F2 E2]; [apply rnd_below_max, small; fold Y; unfold u in *; lra|].
  pose proof (diff_sub _ _ F1) as D1. pose proof (diff_sub _ _ F2) as D2. fold X in D1. fold Y in D2.
  pose proof (app_mul0 1 1 _ _ _ _ _ _ D1 D1) as T1. pose proof (app_mul0 1 1 _ _ _ _ _ _ D2 D2) as T2.
  rewrite <- Rabs_mult, (Rabs_pos_eq (X * X)) in T1 by exact XX. rewrite <- Rabs_mult, (Rabs_pos_eq (Y * Y)) in T2 by exact
    YY.
  pose proof (app_add _ _ _ _ _ _ _ _ _ (rnd_format _) (rnd_format _) T1 T2) as T.
  assert (W2 : bpow radix2 1024 = V * V) by (rewrite <- bpow_plus; reflexivity).
  assert (sq : forall f z, finite f -> diff f z -> z * z <= d * d -> finite (f * f)%D /\ val (f * f)%D = rnd (val f * val f)).
  { intros f z Ff Df Hz. apply fmul_finite; try assumption. apply below_overflow. split; [apply Rle_0_sqr|]. rewrite W2.
    pose proof (app_magnitude _ _ _ _ _ Df) as Mf. rewrite Rplus_0_r in Mf.
    assert (Rabs (val f) * Rabs (val f) <= (1 + u) ^ 1 * Rabs z * ((1 + u) ^ 1 * Rabs z)) by (apply Rmult_le_compat; try
      apply Rabs_pos; exact Mf).
    rewrite <- Rabs_mult, Rabs_pos_eq in H by apply Rle_0_sqr. apply Rle_trans with (1 := H).
    replace ((1 + u) ^ 1 * Rabs z * ((1 + u) ^ 1 * Rabs z)) with (z * z * ((1 + u) * (1 + u))).
    - assert (z * z * ((1 + u) * (1 + u)) <= d * d * ((1 + u) * (1 + u))) by (apply Rmult_le_compat_r; [unfold u|]; lra).
      unfold u in *. lra.
    - assert (Az : Rabs z * Rabs z = z * z) by (rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
      replace ((1 + u) ^ 1 * Rabs z * ((1 + u) ^ 1 * Rabs z)) with (Rabs z * Rabs z * ((1 + u) * (1 + u))) by ring. now rewrite Az. }
  destruct (sq _ X F1 D1 ltac:(lra)) as [G1 V1]. destruct (sq _ Y F2 D2 ltac:(lra)) as [G2 V2].
  rewrite <- V1, <- V2 in T. pose proof (app_magnitude 4 _ _ _ _ T) as Mt.
  assert (Bt : rnd (val ((ax - bx) * (ax - bx))%D + val ((ay - by_) * (ay - by_))%D) < val e).
  { apply Rle_lt_trans with (1 := Rle_abs _). apply Rle_lt_trans with (1 := Mt).
    assert ((1 + u) ^ 4 * (X * X + Y * Y) <= (1 + 5 * u) * (X * X + Y * Y)) by (apply Rmult_le_compat_r; [|unfold u]; lra).
    unfold u in *. lra. }
  destruct (fadd_finite _ _ G1 G2) as [G3 V3].
  { rewrite Rabs_pos_eq; [lra|]. apply rnd_pos, Rplus_le_le_0_compat; [rewrite V1|rewrite V2]; apply rnd_pos, Rle_0_sqr. }
  rewrite <- V3 in Bt. apply (lt_finite _ e G3 Fe) in Bt. unfold square_distance, lift in L. rewrite Bt in L. discriminate.
Qed.

(** A vertex without an edge shorter than `most`. *)
Theorem most_correct ax ay bx by_ most : finite ax -> finite ay -> finite bx -> finite by_ -> finite most ->
  7 / 10 ^ 89 <= val most -> finite (most * most)%D -> lt (square_distance ax ay bx by_) (most * most)%D = false ->
  val most <= dist (val ax, val ay) (val bx, val by_) * (1 + / 10 ^ 12).
Proof.
  intros F1 F2 F3 F4 Fm Lm F L. apply (distance_bound ax ay bx by_ (most * most)%D); try assumption.
  destruct (fmul_inv _ _ F) as (_ & _ & ->). pose proof eta_323.
  assert (7 / 10 ^ 89 * (7 / 10 ^ 89) <= val most * val most) by (apply Rmult_le_compat; lra).
  assert (val most * val most * (1 - u) - eta <= rnd (val most * val most)) by (apply rnd_lower, Rle_0_sqr).
  unfold u in *. lra.
Qed.

(** The root of the least square. *)
Theorem least_correct ax ay bx by_ least : finite ax -> finite ay -> finite bx -> finite by_ -> finite least ->
  7 / 10 ^ 89 <= val (fsqrt least) -> lt (square_distance ax ay bx by_) least = false ->
  val (fsqrt least) <= dist (val ax, val ay) (val bx, val by_) * (1 + / 10 ^ 12).
Proof.
  intros F1 F2 F3 F4 Fl Lm L. apply (distance_bound ax ay bx by_ least); try assumption.
  assert (F : finite (fsqrt least)) by (destruct (fsqrt least); try reflexivity; simpl in Lm; lra).
  destruct (fsqrt_inv _ F) as (_ & P & E). rewrite E in *. pose proof eta_323.
  assert (U : rnd (sqrt (val least)) <= sqrt (val least) * (1 + u) + eta) by (apply rnd_upper, sqrt_pos).
  assert (U' : rnd (sqrt (val least)) <= sqrt (val least) * (1 + 5 / 4 * u)) by (unfold u in *; lra).
  assert (Q : rnd (sqrt (val least)) * rnd (sqrt (val least)) <=
    sqrt (val least) * (1 + 5 / 4 * u) * (sqrt (val least) * (1 + 5 / 4 * u))) by (apply Rmult_le_compat; lra).
  apply Rle_trans with (1 := Q).
  replace (sqrt (val least) * (1 + 5 / 4 * u) * (sqrt (val least) * (1 + 5 / 4 * u))) with
    (sqrt (val least) * sqrt (val least) * ((1 + 5 / 4 * u) * (1 + 5 / 4 * u))) by ring.
  rewrite sqrt_sqrt by exact P. apply Rmult_le_compat_l; [exact P|unfold u; lra].
Qed.
