(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [WIT-NEAR] dyd_filter_edge_near in doubles, underflow, overflow, infinities and NaN included: when it says yes, the
    middle of the two circumcentres is a witness. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt
  FiltersDistance FiltersInterval FiltersNearRound.
From Dyadel Require Import Plane Distance Cells Legal FiltersNearPlane.
Open Scope R_scope.

(* [WIT-NEAR] src/legal/star_filter.h: if (!(a1 - ea >= {} && *)
Definition c_near_a1 : const := (1, -100)%Z.
(* [WIT-NEAR] src/legal/star_filter.h: && a2 - ea >= {} && *)
Definition c_near_a2 : const := (1, -100)%Z.
(* [WIT-NEAR] src/legal/star_filter.h: && s <= {} && *)
Definition c_near_most : const := (1, 98)%Z.
(* [WIT-NEAR] src/legal/star_filter.h: && det >= {} && *)
Definition c_near_least : const := (1, -300)%Z.
(* [WIT-NEAR] src/legal/star_filter.h: det >= 0x1p-300 && {} * reach <= m *)
Definition c_near_ratio : const := (25, 3)%Z.

(* C src/legal/star_filter.h dyd_square_distance
  double x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
*)
Definition square_distance (ax ay bx by_ : double) : double := lift (ax - bx) (ay - by_).
(* C src/legal/star_filter.h dyd_filter_edge_near
  double jx = j.x - i.x, jy = j.y - i.y, ux = u.x - i.x, uy = u.y - i.y, vx = v.x - i.x, vy = v.y - i.y;
  double lj = jx * jx + jy * jy, lu = ux * ux + uy * uy, lv = vx * vx + vy * vy, s = lj + lu + lv;
  double a1 = jx * uy - jy * ux, a2 = vx * jy - vy * jx, cross = ux * vy - uy * vx;
  double ea = 2.1 * 0x1p-53 * s, det = (lj * cross + lu * a2 + lv * a1) - 4.5e-16 * s * s;
  double lw = dyd_square_distance(j, u), lz = dyd_square_distance(j, v), k = 24.3 * reach;
  if (!(a1 - ea >= 0x1p-100 && a2 - ea >= 0x1p-100 && s <= 0x1p98 && det >= 0x1p-300 && 200 * reach <= m)) return false;
  return k * (lu * lw) * (a2 + ea) < m * det * (a1 - ea) && k * (lv * lz) * (a1 + ea) < m * det * (a2 - ea);
*)
Definition filter_edge_near (i_x i_y j_x j_y u_x u_y v_x v_y reach m : double) : bool :=
  let jx := (j_x - i_x)%D in let jy := (j_y - i_y)%D in let ux := (u_x - i_x)%D in let uy := (u_y - i_y)%D in
  let vx := (v_x - i_x)%D in let vy := (v_y - i_y)%D in
  let lu := lift ux uy in let lv := lift vx vy in let s := incircle_s jx jy ux uy vx vy in
  let a1 := cross jx jy ux uy in let a2 := cross vx vy jx jy in
  let ea := (lit c_near_side * s)%D in
  let det := (incircle_d jx jy ux uy vx vy - lit c_near_det * s * s)%D in
  let lw := square_distance j_x j_y u_x u_y in let lz := square_distance j_x j_y v_x v_y in
  let k := (lit c_near_k * reach)%D in
  if negb (le (lit c_near_a1) (a1 - ea) && le (lit c_near_a2) (a2 - ea) && le s (lit c_near_most) &&
           le (lit c_near_least) det && le (lit c_near_ratio * reach) m) then false
  else lt (k * (lu * lw) * (a2 + ea)) (m * det * (a1 - ea)) && lt (k * (lv * lz) * (a1 + ea)) (m * det * (a2 - ea)).

(** ** What true comparisons say *)

Lemma le_from x y : finite x -> le x y = true -> (finite y /\ val x <= val y) \/ y = inf.
Proof.
  intros F H. destruct (cases y) as [G|[G|[G|G]]].
  - left. split; [exact G|]. now apply le_finite.
  - exfalso. destruct y; try discriminate; destruct x; discriminate.
  - now right.
  - exfalso. subst. destruct x; discriminate.
Qed.
Lemma le_to x y : finite y -> nneg x -> le x y = true -> finite x /\ val x <= val y.
Proof.
  intros F N H. destruct (cases x) as [G|[G|[G|G]]].
  - split; [exact G|]. now apply le_finite.
  - exfalso. destruct x; try discriminate; destruct y; discriminate.
  - exfalso. subst. destruct y; discriminate.
  - exfalso. subst. discriminate.
Qed.
Lemma lt_from x y : nneg x -> lt x y = true -> finite x /\ ((finite y /\ val x < val y) \/ y = inf).
Proof.
  intros N H. destruct (cases x) as [G|[G|[G|G]]].
  - split; [exact G|]. destruct (cases y) as [F|[F|[F|F]]].
    + left. split; [exact F|]. now apply lt_finite.
    + exfalso. destruct y; try discriminate; destruct x; discriminate.
    + now right.
    + exfalso. subst. destruct x; discriminate.
  - exfalso. destruct x; try discriminate; destruct y; discriminate.
  - exfalso. subst. destruct y as [|[|]| |]; discriminate.
  - exfalso. subst. discriminate.
Qed.

(** ** Small results do not overflow *)

Lemma fmul_small x y : finite x -> finite y -> Rabs (val x * val y) <= 10 ^ 190 ->
  finite (x * y)%D /\ val (x * y)%D = rnd (val x * val y).
Proof. intros F G H. apply fmul_finite; try assumption. now apply small_max. Qed.
Lemma fadd_small x y : finite x -> finite y -> Rabs (val x + val y) <= 10 ^ 190 ->
  finite (x + y)%D /\ val (x + y)%D = rnd (val x + val y).
Proof. intros F G H. apply fadd_finite; try assumption. now apply small_max. Qed.
Lemma fsub_small x y : finite x -> finite y -> Rabs (val x - val y) <= 10 ^ 190 ->
  finite (x - y)%D /\ val (x - y)%D = rnd (val x - val y).
Proof. intros F G H. apply fsub_finite; try assumption. now apply small_max. Qed.

(** ** The parts *)

(** A side moved to both sides by c s. *)
Lemma side_code a s c least A S : finite a -> finite s -> 0 <= val s ->
  Rabs (val a - A) <= 4001 / 1000 * u * (S / 2) + 3 * eta -> Rabs A <= S / 2 ->
  Rabs (val s - S) <= 601 / 100 * u * S + 7 * eta -> S <= 10 ^ 30 ->
  is_double c = true -> 20999 / 10000 * u <= cval c <= 3 * u ->
  is_double least = true -> cval least = bpow radix2 (-100) -> le (lit least) (a - lit c * s) = true ->
  (finite (a - lit c * s)%D /\ 0 <= val (a - lit c * s)%D <= A * (1 + u)) /\
  (finite (a + lit c * s)%D /\ A * (1 - u) <= val (a + lit c * s)%D <= 10 ^ 32) /\
  39 / 10 ^ 32 <= A <= 10 ^ 30 /\ 39 / 10 ^ 32 <= S.
Proof.
  intros Fa Fs Ps Ea MA Es HS Dc Vc Dl Vl G. pose proof eta_323 as H. pose proof eta_pos as EP.
  destruct (lit_correct c Dc) as [Fc Ec]. destruct (lit_correct least Dl) as [Fl El]. rewrite Vl in El.
  pose proof Ea as Ea'. pose proof MA as MA'. pose proof Es as Es'.
  apply Rabs_le_inv in Ea'. apply Rabs_le_inv in MA'. apply Rabs_le_inv in Es'.
  assert (S0 : 0 <= S) by lra.
  assert (Hs : val s <= 2 * 10 ^ 30) by (unfold u in *; lra).
  assert (cs : 0 <= cval c * val s) by (apply Rmult_le_pos; [unfold u in Vc|]; lra).
  assert (cs' : cval c * val s <= 1 * val s) by (apply Rmult_le_compat_r; [exact Ps|unfold u in Vc; lra]).
  destruct (fmul_small (lit c) s Fc Fs) as [Fe Ee]; [rewrite Ec, Rabs_pos_eq; lra|]. rewrite Ec in Ee.
  assert (Pe : 0 <= val (lit c * s)%D) by (rewrite Ee; now apply rnd_pos).
  assert (Qe : val (lit c * s)%D <= 3 * 10 ^ 30).
  { rewrite Ee. apply Rle_trans with (1 := rnd_upper _ cs). unfold u; lra. }
  destruct (fsub_small a _ Fa Fe) as [Fx Ex]; [apply Rabs_le; unfold u in *; lra|].
  destruct (fadd_small a _ Fa Fe) as [Fy Ey]; [apply Rabs_le; unfold u in *; lra|].
  apply le_finite in G; [|assumption..]. rewrite El, Ex, Ee in G.
  destruct (side_moved _ _ _ _ _ _ (val_format a) Ea MA Ps Es Vc eq_refl G) as (P & Q & R & T).
  rewrite <- Ee, <- Ex in Q. rewrite <- Ee, <- Ey in R.
  split; [now split|]. split; [|lra]. split; [exact Fy|]. split; [exact R|]. rewrite Ey.
  apply Rle_trans with (rnd (10 ^ 31)); [apply rnd_le; unfold u in *; lra|].
  apply Rle_trans with (1 := rnd_upper (10 ^ 31) ltac:(lra)). unfold u; lra.
Qed.

(** Vectors of a triangle next to the edge: squares in terms of the cross product. *)
Lemma squares_from_side jx jy ux uy S : 39 / 10 ^ 32 <= jx * uy - jy * ux -> Lift jx jy <= S -> S <= 10 ^ 30 ->
  15 / 10 ^ 92 <= Lift ux uy /\ 15 / 10 ^ 92 <= Lift (jx - ux) (jy - uy).
Proof.
  intros A L HS. set (a := jx * uy - jy * ux) in *.
  split; apply (square_from_side a (Lift jx jy)); try assumption; try apply Lift_pos; try lra.
  - unfold a, Lift. generalize (Rle_0_sqr (jx * ux + jy * uy)); unfold Rsqr. lra.
  - unfold a, Lift. generalize (Rle_0_sqr (jx * (jx - ux) + jy * (jy - uy))); unfold Rsqr. lra.
Qed.

Lemma det_code d s D S : finite d -> finite s -> 0 <= val s -> val s <= 4 * 10 ^ 29 ->
  Rabs (val d - D) <= 36671 / 10000 * u * (S * S) + 44 / 10 * eta * S + 7 * eta -> Rabs D <= 2 * 10 ^ 60 ->
  Rabs (val s - S) <= 601 / 100 * u * S + 7 * eta -> 39 / 10 ^ 32 <= S -> S <= 10 ^ 30 ->
  le (lit c_near_least) (d - lit c_near_det * s * s) = true ->
  finite (d - lit c_near_det * s * s)%D /\ 39 / 10 ^ 92 <= D /\ 0 <= val (d - lit c_near_det * s * s)%D <= D * (1 + u).
Proof.
  intros Fd Fs Ps Hs Ed MD Es LS HS G. pose proof eta_323 as H. pose proof eta_pos as EP.
  destruct (lit_correct c_near_det eq_refl) as [Fc Ec]. destruct (lit_correct c_near_least eq_refl) as [Fl El].
  assert (C : 0 <= cval c_near_det <= 1) by (unfold c_near_det; split; numerals; lra).
  assert (cs : 0 <= cval c_near_det * val s <= 1 * val s) by (split; [apply Rmult_le_pos|apply Rmult_le_compat_r]; lra).
  destruct (fmul_small (lit c_near_det) s Fc Fs) as [Fq Eq]; [rewrite Ec, Rabs_pos_eq; lra|]. rewrite Ec in Eq.
  set (q := (lit c_near_det * s)%D) in *.
  assert (Pq : 0 <= val q <= 10 ^ 30).
  { rewrite Eq. split; [now apply rnd_pos|]. apply Rle_trans with (1 := rnd_upper _ (proj1 cs)). unfold u; lra. }
  assert (qs : 0 <= val q * val s <= 10 ^ 30 * 10 ^ 30) by (split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra).
  destruct (fmul_small q s Fq Fs) as [Fb Eb]; [rewrite Rabs_pos_eq; lra|].
  assert (Pb : 0 <= val (q * s)%D <= 2 * 10 ^ 60).
  { rewrite Eb. split; [now apply rnd_pos|]. apply Rle_trans with (1 := rnd_upper _ (proj1 qs)). unfold u; lra. }
  pose proof Ed as Ed'. apply Rabs_le_inv in Ed'. apply Rabs_le_inv in MD.
  assert (SS : S * S <= 10 ^ 30 * 10 ^ 30) by (apply Rmult_le_compat; lra).
  assert (eS : eta * S <= / 10 ^ 323 * S) by (apply Rmult_le_compat_r; lra).
  destruct (fsub_small d _ Fd Fb) as [Fx Ex]; [apply Rabs_le; unfold u in *; lra|].
  apply le_finite in G; [|assumption..].
  replace (val (lit c_near_least)) with (bpow radix2 (-300)) in G by (rewrite El; unfold c_near_least, cval, fst, snd;
    ring).
  rewrite Ex, Eb, Eq in G.
  destruct (det_moved _ _ _ _ (val_format d) Ed Ps Es LS G) as (P & Q).
  split; [exact Fx|]. split; [exact P|]. now rewrite Ex, Eb, Eq.
Qed.

(** One of the two comparisons. *)
Lemma compare_code reach lu lw LU LW y A2 m M det D x A1 : finite reach -> 4 / 10 ^ 91 <= val reach ->
  nneg lu -> nneg lw -> (finite lu -> LU * (1 - 5 * u) <= val lu) -> (finite lw -> LW * (1 - 5 * u) <= val lw) ->
  15 / 10 ^ 92 <= LU -> 15 / 10 ^ 92 <= LW ->
  finite y -> A2 * (1 - u) <= val y -> 39 / 10 ^ 32 <= A2 ->
  finite m -> 7 / 10 ^ 89 <= val m -> val m <= M * (1 + / 10 ^ 12) -> M <= 10 ^ 30 ->
  finite det -> 0 <= val det <= D * (1 + u) -> 39 / 10 ^ 92 <= D -> D <= 2 * 10 ^ 60 ->
  finite x -> 0 <= val x <= A1 * (1 + u) -> 39 / 10 ^ 32 <= A1 -> A1 <= 10 ^ 30 ->
  lt (lit c_near_k * reach * (lu * lw) * y)%D (m * det * x)%D = true ->
  2425 / 100 * val reach * (LU * LW) * A2 < M * D * A1.
Proof.
  intros Fr Er Nu Nw Hu Hw LLU LLW Fy Hy LA2 Fm Lm Hm BM Fd Hd LD BD Fx Hx LA1 BA C.
  assert (N : nneg (lit c_near_k * reach * (lu * lw) * y)%D).
  { repeat apply nneg_mul; try assumption; [apply nneg_lit; [reflexivity|simpl; lia]|..].
    - apply nneg_of_val; [exact Fr|lra].
    - apply nneg_of_val; [exact Fy|]. unfold u in *; lra. }
  destruct (lt_from _ _ N C) as [FL _]. destruct (fmul_inv _ _ FL) as (F1 & _ & E1).
  destruct (fmul_inv _ _ F1) as (F2 & F3 & E2). destruct (fmul_inv _ _ F2) as (_ & _ & E3).
  destruct (fmul_inv _ _ F3) as (F4 & F5 & E4).
  assert (B1 : 0 <= val m * val det <= 2 * 10 ^ 30 * (4 * 10 ^ 60)).
  { split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; unfold u in *; lra]. }
  destruct (fmul_small m det Fm Fd) as [F6 E6]; [rewrite Rabs_pos_eq; lra|].
  assert (B2 : 0 <= val (m * det)%D <= 10 ^ 92).
  { rewrite E6. split; [apply rnd_pos; lra|]. apply Rle_trans with (1 := rnd_upper _ (proj1 B1)).
    pose proof eta_323. unfold u; lra. }
  assert (B3 : 0 <= val (m * det)%D * val x <= 10 ^ 92 * (2 * 10 ^ 30)).
  { split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; unfold u in *; lra]. }
  destruct (fmul_small (m * det)%D x F6 Fx) as [F7 E7]; [rewrite Rabs_pos_eq; lra|].
  apply lt_finite in C; [|assumption..]. rewrite E1, E2, E3, E4, E7, E6 in C. lits C.
  apply (compared (val reach) (val lu) (val lw) LU LW (val y) A2 (val m) M (val det) D (val x) A1); try assumption.
  - now apply Hu.
  - now apply Hw.
Qed.

Lemma det3_size ax ay bx by_ cx cy S : Lift ax ay <= S -> Lift bx by_ <= S -> Lift cx cy <= S ->
  Rabs (bx * cy - by_ * cx) <= S / 2 -> Rabs (cx * ay - cy * ax) <= S / 2 -> Rabs (ax * by_ - ay * bx) <= S / 2 ->
  Rabs (det3 ax ay bx by_ cx cy) <= 3 / 2 * (S * S).
Proof.
  intros A B C X Y Z. pose proof (Lift_pos ax ay). pose proof (Lift_pos bx by_). pose proof (Lift_pos cx cy).
  assert (K : forall l x, 0 <= l -> l <= S -> Rabs x <= S / 2 -> Rabs (l * x) <= S * (S / 2)).
  { intros l x P L Q. rewrite Rabs_mult, (Rabs_pos_eq l) by exact P. apply Rmult_le_compat; try assumption.
    apply Rabs_pos. }
  unfold det3. fold (Lift ax ay) (Lift bx by_) (Lift cx cy).
  pose proof (K _ _ H A X) as K1. pose proof (K _ _ H0 B Y) as K2. pose proof (K _ _ H1 C Z) as K3.
  apply Rabs_le_inv in K1. apply Rabs_le_inv in K2. apply Rabs_le_inv in K3. apply Rabs_le. lra.
Qed.

(** m is at least 200 times the reach, after rounding. *)
Lemma ratio_code c reach m M : is_double c = true -> cval c = 200 -> finite reach -> 4 / 10 ^ 91 <= val reach ->
  finite m -> val m <= M * (1 + / 10 ^ 12) -> le (lit c * reach) m = true ->
  7 / 10 ^ 89 <= val m /\ 199 * val reach <= M /\ 0 < M.
Proof.
  intros Dc Vc Fr Er Fm Hm G. destruct (lit_correct c Dc) as [Fc Ec]. rewrite Vc in Ec.
  assert (N : nneg (lit c * reach)%D) by (apply nneg_mul; apply nneg_of_val; try assumption; lra).
  destruct (le_to _ _ Fm N G) as [F H]. destruct (fmul_inv _ _ F) as (_ & _ & E). rewrite E, Ec in H.
  assert (200 * val reach * (1 - u) - eta <= rnd (200 * val reach)) by (apply rnd_lower; lra).
  pose proof eta_323. unfold u in *. repeat split; lra.
Qed.

(** ** The theorem *)

(** M: a true distance; m: a double that is at most that, up to 10^-12 of itself. *)
Theorem filter_edge_near_conditions i_x i_y j_x j_y u_x u_y v_x v_y reach m M :
  let i := (val i_x, val i_y) in let j := (val j_x, val j_y) in
  let u := (val u_x, val u_y) in let v := (val v_x, val v_y) in
  finite reach -> bpow radix2 (-300) <= val reach -> finite m -> val m <= M * (1 + / 10 ^ 12) -> M <= dist i j ->
  filter_edge_near i_x i_y j_x j_y u_x u_y v_x v_y reach m = true ->
  0 < M /\ 199 * val reach <= M /\ 0 < cross_at i j u /\ 0 < cross_at i v j /\ 0 < det_at i j u v /\
  2425 / 100 * val reach * (dist2 u i * dist2 u j) * cross_at i v j < M * det_at i j u v * cross_at i j u /\
  2425 / 100 * val reach * (dist2 v i * dist2 v j) * cross_at i j u < M * det_at i j u v * cross_at i v j.
Proof.
  intros i j p q Fr Er Fm Hm HM. unfold filter_edge_near. cbv zeta.
  set (jx := (j_x - i_x)%D). set (jy := (j_y - i_y)%D). set (ux := (u_x - i_x)%D). set (uy := (u_y - i_y)%D).
  set (vx := (v_x - i_x)%D). set (vy := (v_y - i_y)%D). set (s := incircle_s jx jy ux uy vx vy).
  destruct (_ && _ && _ && _ && _) eqn:G; [|discriminate]. cbn [negb].
  apply andb_prop in G. destruct G as [G G5]. apply andb_prop in G. destruct G as [G G4].
  apply andb_prop in G. destruct G as [G G3]. apply andb_prop in G. destruct G as [G1 G2].
  intros G. apply andb_prop in G. destruct G as [C1 C2].
  pose proof eta_323 as H323. pose proof eta_pos as EP. pose proof least_reach as LR.
  assert (Er' : 4 / 10 ^ 91 <= val reach) by lra.
  destruct (ratio_code c_near_ratio reach m M eq_refl ltac:(unfold c_near_ratio; numerals; lra) Fr Er' Fm Hm G5) as (Lm &
    EM & PM).
  assert (Ns : nneg s) by (unfold s, incircle_s, lift; repeat apply nneg_add; apply nneg_sqr).
  destruct (lit_correct c_near_most eq_refl) as [Fl El]. destruct (le_to _ _ Fl Ns G3) as [Fs Hs].
  rewrite El in Hs. replace (cval c_near_most) with (bpow radix2 98) in Hs by (unfold c_near_most, cval, fst, snd; ring).
  pose proof most_squares as MS. pose proof (nneg_val _ Ns) as Ps.
  pose proof Fs as Fs'. unfold s, incircle_s in Fs'. destruct (fadd_inv _ _ Fs') as (Fab & Flv & _).
  destruct (fadd_inv _ _ Fab) as (Flj & Flu & _).
  destruct (fadd_inv _ _ Flj) as (M1 & M2 & _). destruct (fadd_inv _ _ Flu) as (M3 & M4 & _).
  destruct (fadd_inv _ _ Flv) as (M5 & M6 & _).
  destruct (fmul_inv _ _ M1) as (Fjx & _ & _). destruct (fmul_inv _ _ M2) as (Fjy & _ & _).
  destruct (fmul_inv _ _ M3) as (Fux & _ & _). destruct (fmul_inv _ _ M4) as (Fuy & _ & _).
  destruct (fmul_inv _ _ M5) as (Fvx & _ & _). destruct (fmul_inv _ _ M6) as (Fvy & _ & _).
  pose proof (diff_sub _ _ Fjx) as D1. pose proof (diff_sub _ _ Fjy) as D2. pose proof (diff_sub _ _ Fux) as D3.
  pose proof (diff_sub _ _ Fuy) as D4. pose proof (diff_sub _ _ Fvx) as D5. pose proof (diff_sub _ _ Fvy) as D6.
  fold jx in D1. fold jy in D2. fold ux in D3. fold uy in D4. fold vx in D5. fold vy in D6.
  pose proof (incircle_s_error _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fs) as ES. cbv zeta in ES. fold s in ES.
  set (JX := val j_x - val i_x) in *. set (JY := val j_y - val i_y) in *. set (UX := val u_x - val i_x) in *.
  set (UY := val u_y - val i_y) in *. set (VX := val v_x - val i_x) in *. set (VY := val v_y - val i_y) in *.
  pose proof (Lift_pos JX JY) as PJ. pose proof (Lift_pos UX UY) as PU. pose proof (Lift_pos VX VY) as PV.
  set (S := Lift JX JY + Lift UX UY + Lift VX VY) in *.
  assert (HS : S <= 10 ^ 30) by (apply Rabs_le_inv in ES; unfold u in *; lra).
  pose proof V_big as VB. assert (SV : S <= 101 / 100 * V) by lra. assert (SV2 : S <= 2 * V) by lra.
  assert (Fa1 : finite (cross jx jy ux uy)).
  { apply (cross_finite _ _ _ _ JX JY UX UY S); try assumption. unfold S; lra. }
  assert (Fa2 : finite (cross vx vy jx jy)).
  { apply (cross_finite _ _ _ _ VX VY JX JY S); try assumption. unfold S; lra. }
  assert (Fcr : finite (cross ux uy vx vy)).
  { apply (cross_finite _ _ _ _ UX UY VX VY S); try assumption. unfold S; lra. }
  destruct (cross_side _ _ _ _ _ _ _ _ S D1 D2 D3 D4 Fa1 ltac:(unfold S; lra)) as [E1 B1].
  destruct (cross_side _ _ _ _ _ _ _ _ S D5 D6 D1 D2 Fa2 ltac:(unfold S; lra)) as [E2 B2].
  destruct (cross_side _ _ _ _ _ _ _ _ S D3 D4 D5 D6 Fcr ltac:(unfold S; lra)) as [_ B3].
  assert (CS : 20999 / 10000 * u <= cval c_near_side <= 3 * u) by (unfold c_near_side, u; split; numerals; lra).
  destruct (side_code _ s c_near_side c_near_a1 _ S Fa1 Fs Ps E1 B1 ES HS eq_refl CS eq_refl
    ltac:(unfold c_near_a1, cval, fst, snd; ring) G1) as ((Fx1 & X1) & (Fy1 & Y1) & A1 & LS).
  destruct (side_code _ s c_near_side c_near_a2 _ S Fa2 Fs Ps E2 B2 ES HS eq_refl CS eq_refl
    ltac:(unfold c_near_a2, cval, fst, snd; ring) G2) as ((Fx2 & X2) & (Fy2 & Y2) & A2 & _).
  destruct (incircle_d_parts _ _ _ _ _ _ _ _ _ _ _ _ D1 D2 D3 D4 D5 D6 Fjx Fjy Fux Fuy Fvx Fvy Flj Flu Flv SV) as (Ft1
    & Ft2 & Ed).
  fold S in Ed.
  assert (BD : Rabs (det3 JX JY UX UY VX VY) <= 3 / 2 * (S * S)).
  { apply det3_size; try assumption; unfold S; lra. }
  assert (SS : S * S <= 10 ^ 30 * 10 ^ 30) by (apply Rmult_le_compat; lra).
  assert (Fd : finite (incircle_d jx jy ux uy vx vy) /\ val (incircle_d jx jy ux uy vx vy) =
    rnd (val (term jx jy ux uy vx vy + term ux uy vx vy jx jy)%D + val (term vx vy jx jy ux uy))).
  { unfold incircle_d. apply fadd_finite; [exact Ft1|exact Ft2|]. apply below_max.
    apply Rabs_le_inv in Ed. apply Rabs_le_inv in BD. pose proof VV_big. apply Rabs_le.
    assert (eta * S <= / 10 ^ 323 * S) by (apply Rmult_le_compat_r; lra). unfold u in Ed. lra. }
  destruct Fd as [Fd Vd]. rewrite <- Vd in Ed.
  destruct (det_code _ s _ S Fd Fs Ps ltac:(lra) Ed ltac:(lra) ES LS HS G4) as (Fdet & LD & HD).
  pose proof (Rle_abs (det3 JX JY UX UY VX VY)) as AD.
  assert (MB : M <= 10 ^ 30).
  { apply Rle_trans with (1 := HM). apply le_of_squares; [lra|]. rewrite dist_sq.
    replace (dist2 i j) with (Lift JX JY) by (unfold dist2, Lift, JX, JY, i, j; cbn [fst snd]; ring).
    apply Rle_trans with S; [unfold S; lra|lra]. }
  destruct (squares_from_side JX JY UX UY S ltac:(lra) ltac:(unfold S; lra) HS) as [LU LW].
  assert (sw : forall x y, Lift x y = Lift y x) by (intros; unfold Lift; ring).
  destruct (squares_from_side JY JX VY VX S ltac:(lra) ltac:(rewrite sw; unfold S; lra) HS) as [LV LZ].
  rewrite sw in LV. rewrite sw in LZ.
  assert (Nl : forall x y, nneg (lift x y)) by (intros; unfold lift; apply nneg_add; apply nneg_sqr).
  assert (Low : forall x y X Y, diff x X -> diff y Y -> 15 / 10 ^ 92 <= Lift X Y -> finite (lift x y) ->
    Lift X Y * (1 - 5 * u) <= val (lift x y)).
  { intros x y X Y Dx Dy L F. apply (lift_near x y X Y Dx Dy F). lra. }
  assert (Far : forall k_x k_y, 15 / 10 ^ 92 <= Lift (JX - (val k_x - val i_x)) (JY - (val k_y - val i_y)) ->
    finite (square_distance j_x j_y k_x k_y) ->
    Lift (JX - (val k_x - val i_x)) (JY - (val k_y - val i_y)) * (1 - 5 * u) <= val (square_distance j_x j_y k_x k_y)).
  { intros k_x k_y L F. unfold square_distance in *. pose proof F as F'. unfold lift in F'.
    destruct (fadd_inv _ _ F') as (N1 & N2 & _). destruct (fmul_inv _ _ N1) as (Fx & _ & _).
    destruct (fmul_inv _ _ N2) as (Fy & _ & _). pose proof (diff_sub _ _ Fx) as Dx. pose proof (diff_sub _ _ Fy) as Dy.
    replace (val j_x - val k_x) with (JX - (val k_x - val i_x)) in Dx by (unfold JX; ring).
    replace (val j_y - val k_y) with (JY - (val k_y - val i_y)) in Dy by (unfold JY; ring).
    now apply Low. }
  assert (X : cross_at i j p = JX * UY - JY * UX) by reflexivity.
  assert (Y : cross_at i q j = VX * JY - VY * JX) by reflexivity.
  assert (Z : det_at i j p q = det3 JX JY UX UY VX VY) by reflexivity.
  assert (QU : dist2 p i = Lift UX UY) by reflexivity. assert (QV : dist2 q i = Lift VX VY) by reflexivity.
  assert (QW : dist2 p j = Lift (JX - UX) (JY - UY)) by (unfold dist2, Lift, JX, JY, UX, UY, p, j; cbn [fst snd]; ring).
  assert (QZ : dist2 q j = Lift (JX - VX) (JY - VY)) by (unfold dist2, Lift, JX, JY, VX, VY, q, j; cbn [fst snd]; ring).
  rewrite X, Y, Z, QU, QV, QW, QZ.
  split; [exact PM|]. split; [exact EM|]. split; [lra|]. split; [lra|]. split; [lra|]. split.
  - apply (compare_code reach (lift ux uy) (square_distance j_x j_y u_x u_y) _ _ _ _ m M _ _ _ _ Fr Er' (Nl _ _) (Nl _ _)
      (Low _ _ _ _ D3 D4 LU) (Far _ _ LW) LU LW Fy2 (proj1 Y2) (proj1 A2) Fm Lm Hm MB Fdet HD LD ltac:(lra) Fx1 X1
      (proj1 A1) (proj2 A1) C1).
  - apply (compare_code reach (lift vx vy) (square_distance j_x j_y v_x v_y) _ _ _ _ m M _ _ _ _ Fr Er' (Nl _ _) (Nl _ _)
      (Low _ _ _ _ D5 D6 LV) (Far _ _ LZ) LV LZ Fy1 (proj1 Y1) (proj1 A1) Fm Lm Hm MB Fdet HD LD ltac:(lra) Fx2 X2
      (proj1 A2) (proj2 A2) C2).
Qed.

(** Representatives are doubles; every rectangle is within the reach of its own; no representative inside the two
    circumcircles; M bounds the distances from i and j to all others, and m is at most M up to 10^-12 of it. *)
Theorem filter_edge_near_correct N B (x y : nat -> double) i j k l c1 c2 reach m M :
  let p q := (val (x q), val (y q)) in
  finite reach -> bpow radix2 (-300) <= val reach -> within N B p (val reach) -> (i < N)%nat -> (j < N)%nat ->
  empty_circle N p c1 i j k -> empty_circle N p c2 i j l -> alone N p M i j ->
  finite m -> val m <= M * (1 + / 10 ^ 12) ->
  filter_edge_near (x i) (y i) (x j) (y j) (x k) (y k) (x l) (y l) reach m = true ->
  witness N B i j (mix (1 / 2) c1 c2).
Proof.
  intros p Fr Er W I J Q1 Q2 A Fm Hm G.
  destruct (filter_edge_near_conditions _ _ _ _ _ _ _ _ reach m M Fr Er Fm Hm (proj1 A) G) as (PM & EM & S1 & S2 & D &
    C1 & C2).
  assert (0 <= val reach) by (generalize (bpow_gt_0 radix2 (-300)); lra).
  now apply (edge_near_legal N B p (val reach) M i j k l c1 c2).
Qed.
