(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-DIR] Heights along a direction in doubles: each site that reaches as far as v is visited; infinite boxes,
    overflow, underflow and NaN included. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircleAt FiltersDistance
  FiltersInterval FiltersNearRound FiltersNearCode.
Open Scope R_scope.

(* [FLT-DIR] src/skeleton/rects_filter.c: double r = px + py + {} * (fabs(px) + fabs(py)) *)
Definition c_reach : const := (1, -50)%Z.
(* [FLT-DIR] src/skeleton/rects_filter.c: double slack = {} * (fabs(ux) * mx *)
Definition c_height : const := (1, -48)%Z.
(* [FLT-DIR] src/skeleton/rects_filter.c: fabs(uy) * my) + {} * (mx + my) *)
Definition c_height_cut : const := (1, -898)%Z.

(* C src/skeleton/rects_filter.c reach
  double px = ux * (ux > 0 ? b->e[1] : b->e[0]), py = uy * (uy > 0 ? b->e[3] : b->e[2]);
  double r = px + py + 8 * 0x1p-53 * (fabs(px) + fabs(py)) + DYD_TINY;
  return isnan(r) ? INFINITY : r;
*)
Definition farther_end (ux lower upper : double) : double := if gt ux (lit c_zero) then upper else lower.
Definition reach (b : bbox) (ux uy : double) : double :=
  let px := (ux * farther_end ux (e0 b) (e1 b))%D in let py := (uy * farther_end uy (e2 b) (e3 b))%D in
  let r := (px + py + lit c_reach * (fabs px + fabs py) + lit c_tiny)%D in
  if is_nan 53 1024 r then inf else r.
(* C src/skeleton/rects_filter.c dyd_height_lower
  const dyd_bbox *all = &r->tree.node[r->tree.level[r->tree.levels - 1]];
  double mx = dyd_max(fabs(all->e[0]), fabs(all->e[1])), my = dyd_max(fabs(all->e[2]), fabs(all->e[3]));
  double x = ux > 0 ? p->e[1] : p->e[0], y = uy > 0 ? p->e[3] : p->e[2];
  double slack = 32 * 0x1p-53 * (fabs(ux) * mx + fabs(uy) * my) + 0x1p-898 * (mx + my) + DYD_TINY;
  double h = ux * x + uy * y - slack;
  return isnan(h) ? -INFINITY : h;
*)
Definition height_slack (ux uy mx my : double) : double :=
  (lit c_height * (fabs ux * mx + fabs uy * my) + lit c_height_cut * (mx + my) + lit c_tiny)%D.
Definition height_lower (all : bbox) (ux uy : double) (p : bbox) : double :=
  let mx := fmax (fabs (e0 all)) (fabs (e1 all)) in let my := fmax (fabs (e2 all)) (fabs (e3 all)) in
  let h := (ux * farther_end ux (e0 p) (e1 p) + uy * farther_end uy (e2 p) (e3 p) - height_slack ux uy mx my)%D in
  if is_nan 53 1024 h then ninf else h.

(** ** The reach of a box *)

Lemma add_not_ninf x y : nneg y -> x <> ninf -> (x + y)%D <> ninf.
Proof.
  intros N H. destruct (cases x) as [F|[F|[F|F]]].
  - destruct (cases y) as [S|[S|[S|S]]].
    + intros E. destruct (fadd_total x y F S) as [[G _]|[[E' _]|[_ A]]]; [rewrite E in G; discriminate|rewrite E in E';
      discriminate|].
      assert (val x <= rnd (val x + val y)).
      { rewrite <- (rnd_id (val x)) at 1 by apply val_format. apply rnd_le. generalize (nneg_val _ N). lra. }
      generalize (val_lt_max x) (Rle_abs (- val x)). rewrite Rabs_Ropp. lra.
    + now apply add_nan.
    + rewrite S. apply add_pinf.
    + rewrite S in N. discriminate.
  - now apply nan_add.
  - rewrite F. apply inf_add_any.
  - contradiction.
Qed.

(** A sum whose sum of sizes is finite is finite. *)
Lemma fadd_of_abs x y : finite (fabs x + fabs y)%D -> finite (x + y)%D.
Proof.
  intros F. destruct (fadd_inv _ _ F) as (Fx & Fy & E). rewrite fabs_finite in Fx, Fy. rewrite !fabs_val in E.
  apply fadd_finite; try assumption. rewrite <- rnd_abs.
  apply Rle_lt_trans with (rnd (Rabs (val x) + Rabs (val y))); [apply rnd_le, Rabs_triang|].
  rewrite <- E. apply Rle_lt_trans with (1 := Rle_abs _). apply val_lt_max.
Qed.

Lemma reach_rounding p q : format p -> format q ->
  let t := rnd (Rabs p + Rabs q) in
  p + q + 3 * u * (Rabs p + Rabs q) + 5 * eta <= rnd (rnd (rnd (p + q) + rnd (cval c_reach * t)) + cval c_tiny).
Proof.
  intros Fp Fq t. pose proof eta_pos as EP. pose proof tiny_eta as T.
  assert (C : cval c_reach = 8 * u) by (unfold c_reach, u; numerals; lra). rewrite C.
  pose proof (Rabs_pos p) as Pp. pose proof (Rabs_pos q) as Pq. set (s := Rabs p + Rabs q) in *.
  assert (Ft : s * (1 - u) <= t <= s * (1 + u)).
  { split; [apply rnd_add_lower|apply rnd_add_upper]; try (now apply generic_format_abs); unfold s; lra. }
  assert (A1 : Rabs (rnd (p + q) - (p + q)) <= u * s).
  { apply Rle_trans with (1 := rnd_add_error p q Fp Fq). apply Rmult_le_compat_l; [unfold u; lra|apply Rabs_triang]. }
  set (s1 := rnd (p + q)) in *.
  assert (B : Rabs (p + q) <= s) by apply Rabs_triang.
  apply Rabs_le_inv in A1. apply Rabs_le_inv in B.
  assert (Q : 8 * u * t * (1 - u) - eta <= rnd (8 * u * t) <= 8 * u * t * (1 + u) + eta).
  { split; [apply rnd_lower|apply rnd_upper]; apply Rmult_le_pos; unfold u in *; lra. }
  set (g := rnd (8 * u * t)) in *.
  assert (A2 : Rabs (rnd (s1 + g) - (s1 + g)) <= u * (s * (1 + 20 * u) + eta)).
  { apply Rle_trans with (1 := rnd_add_error s1 g (rnd_format _) (rnd_format _)).
    apply Rmult_le_compat_l; [unfold u; lra|]. apply Rabs_le. unfold u in *; lra. }
  set (s2 := rnd (s1 + g)) in *. apply Rabs_le_inv in A2.
  assert (FT : format (cval c_tiny)) by (rewrite <- (proj2 (lit_correct c_tiny eq_refl)); apply val_format).
  assert (A3 : Rabs (rnd (s2 + cval c_tiny) - (s2 + cval c_tiny)) <= u * (s * (1 + 30 * u) + 2 * eta + cval c_tiny)).
  { apply Rle_trans with (1 := rnd_add_error s2 (cval c_tiny) (rnd_format _) FT).
    apply Rmult_le_compat_l; [unfold u; lra|]. apply Rabs_le. unfold u in *; lra. }
  apply Rabs_le_inv in A3. rewrite T in *. unfold u in *; lra.
Qed.

Lemma product_error x y : Rabs (rnd (x * y) - x * y) <= u * Rabs (rnd (x * y)) * (1 + 2 * u) + 2 * eta.
Proof.
  pose proof (rnd_error (x * y)) as E. pose proof eta_pos as P.
  pose proof (Rabs_triang (rnd (x * y)) (- (rnd (x * y) - x * y))) as T. rewrite Rabs_Ropp in T.
  replace (rnd (x * y) + - (rnd (x * y) - x * y)) with (x * y) in T by ring.
  set (a := Rabs (x * y)) in *. set (r := Rabs (rnd (x * y))) in *. set (d := Rabs (rnd (x * y) - x * y)) in *.
  assert (0 <= r) by apply Rabs_pos. unfold u in *; lra.
Qed.

(** The end that is taken reaches as far as any number of the interval. *)
Lemma farther_end_far ux lower upper x : finite ux -> lower_end lower x -> upper_end upper x ->
  finite (farther_end ux lower upper) -> val ux * x <= val ux * val (farther_end ux lower upper).
Proof.
  intros Fu L U. destruct zero_lit as [Fz Vz]. unfold farther_end.
  generalize (gt_finite ux (lit c_zero) Fu Fz). rewrite Vz. destruct (gt ux (lit c_zero)); intros [I J] F.
  - specialize (I eq_refl). destruct U as [->|[_ U]]; [discriminate|]. apply Rmult_le_compat_l; lra.
  - assert (N : val ux <= 0) by (destruct (Rle_or_lt (val ux) 0) as [K|K]; [exact K|discriminate (J K)]).
    destruct L as [->|[_ L]]; [discriminate|].
    assert (- val ux * val lower <= - val ux * x) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** Never NaN; infinite, or an upper bound of u.x over the box. *)
Theorem reach_upper b ux uy x y : finite ux -> finite uy -> lower_end (e0 b) x -> upper_end (e1 b) x ->
  lower_end (e2 b) y -> upper_end (e3 b) y ->
  reach b ux uy = inf \/ (finite (reach b ux uy) /\ val ux * x + val uy * y <= val (reach b ux uy)).
Proof.
  intros Fu Fv L0 U0 L1 U1. unfold reach. cbv zeta.
  set (px := (ux * farther_end ux (e0 b) (e1 b))%D). set (py := (uy * farther_end uy (e2 b) (e3 b))%D).
  set (q := (lit c_reach * (fabs px + fabs py))%D). set (r := (px + py + q + lit c_tiny)%D).
  destruct (lit_correct c_tiny eq_refl) as [Ft Vt].
  assert (Nt : nneg (lit c_tiny)) by (apply nneg_lit; [reflexivity|simpl; lia]).
  assert (Nq : nneg q) by (apply nneg_mul; [apply nneg_lit; [reflexivity|simpl; lia]|apply nneg_add; apply nneg_abs]).
  destruct (cases r) as [F|[F|[F|F]]].
  - right. replace (is_nan 53 1024 r) with false by (destruct r; try discriminate; reflexivity). split; [exact F|].
    unfold r in *. destruct (fadd_inv _ _ F) as (F1 & _ & E1). destruct (fadd_inv _ _ F1) as (F2 & F3 & E2).
    destruct (fadd_inv _ _ F2) as (Fx & Fy & E3). unfold q in F3. destruct (fmul_inv _ _ F3) as (_ & F4 & E4). fold q in E4.
    destruct (fadd_inv _ _ F4) as (_ & _ & E5). rewrite !fabs_val in E5.
    rewrite E1, E2, E3, E4, E5, Vt, (proj2 (lit_correct c_reach eq_refl)).
    apply Rle_trans with (2 := reach_rounding (val px) (val py) (val_format _) (val_format _)).
    destruct (fmul_inv _ _ Fx) as (_ & Gx & Vx). destruct (fmul_inv _ _ Fy) as (_ & Gy & Vy).
    fold px in Vx. fold py in Vy.
    pose proof (farther_end_far ux _ _ x Fu L0 U0 Gx) as Mx. pose proof (farther_end_far uy _ _ y Fv L1 U1 Gy) as My.
    pose proof (product_error (val ux) (val (farther_end ux (e0 b) (e1 b)))) as Ex. rewrite <- Vx in Ex.
    pose proof (product_error (val uy) (val (farther_end uy (e2 b) (e3 b)))) as Ey. rewrite <- Vy in Ey.
    apply Rabs_le_inv in Ex. apply Rabs_le_inv in Ey. pose proof (Rabs_pos (val px)). pose proof (Rabs_pos (val py)).
    pose proof eta_pos. unfold u in *; lra.
  - left. now rewrite F.
  - left. rewrite F. reflexivity.
  - exfalso. unfold r in F. revert F. apply add_not_ninf; [exact Nt|]. intros E.
    destruct (cases (px + py)%D) as [G|[G|[G|G]]].
    + revert E. apply add_not_ninf; [exact Nq|]. intros E. rewrite E in G. discriminate.
    + revert E. now apply nan_add.
    + revert E. rewrite G. apply inf_add_any.
    + destruct (cases q) as [K|[K|[K|K]]].
      * unfold q in K. destruct (fmul_inv _ _ K) as (_ & K' & _). apply fadd_of_abs in K'. rewrite G in K'. discriminate.
      * revert E. now apply add_nan.
      * revert E. rewrite K. apply add_pinf.
      * rewrite K in Nq. discriminate.
Qed.

(** ** The height of a box *)

(** The box p has numbers, and lies in the box of all. *)
Definition in_box (p all : bbox) : Prop :=
  (le (e0 all) (e0 p) = true /\ le (e0 p) (e1 p) = true /\ le (e1 p) (e1 all) = true) /\
  (le (e2 all) (e2 p) = true /\ le (e2 p) (e3 p) = true /\ le (e3 p) (e3 all) = true).

Lemma le_between a x y b : finite a -> finite b -> le a x = true -> le x y = true -> le y b = true ->
  (finite x /\ val a <= val x <= val b) /\ (finite y /\ val a <= val y <= val b).
Proof.
  intros Fa Fb H1 H2 H3. destruct (le_from a x Fa H1) as [[Fx A]| ->].
  - destruct (le_from x y Fx H2) as [[Fy B]| ->]; [|destruct b; discriminate].
    apply le_finite in H3; [|assumption..]. repeat split; try assumption; lra.
  - exfalso. destruct y as [|[|]| |]; try discriminate. destruct b; discriminate.
Qed.

(** The largest size of a coordinate. *)
Lemma size_of_ends a b : is_nan 53 1024 a = false -> is_nan 53 1024 b = false -> finite (fmax (fabs a) (fabs b)) ->
  finite a /\ finite b /\ Rabs (val a) <= val (fmax (fabs a) (fabs b)) /\ Rabs (val b) <= val (fmax (fabs a) (fabs b)).
Proof.
  intros Na Nb F. assert (A : finite a \/ fabs a = inf).
  { destruct a as [|[|]| |]; try discriminate; [now left|now right|now right|now left]. }
  assert (B : finite b \/ fabs b = inf).
  { destruct b as [|[|]| |]; try discriminate; [now left|now right|now right|now left]. }
  unfold fmax in *. destruct A as [A|A]; destruct B as [B|B].
  - rewrite <- !fabs_val. rewrite <- fabs_finite in A, B. generalize (gt_finite (fabs a) (fabs b) A B).
    rewrite fabs_finite in A, B. destruct (gt (fabs a) (fabs b)); intros [I J].
    + specialize (I eq_refl). repeat split; try assumption; lra.
    + assert (val (fabs a) <= val (fabs b)) by (destruct (Rle_or_lt (val (fabs a)) (val (fabs b))) as [L|L]; [exact
        L|discriminate (J L)]). repeat split; try assumption; lra.
  - exfalso. rewrite B in F. replace (gt (fabs a) inf) with false in F; [discriminate|].
    destruct (fabs a) as [|[|]| |]; reflexivity.
  - exfalso. rewrite A in F. rewrite <- fabs_finite in B. rewrite (gt_of_inf _ B) in F. discriminate.
  - exfalso. rewrite A, B in F. discriminate.
Qed.

Lemma height_rounding ux x uy y mx my : 0 <= mx -> 0 <= my -> Rabs x <= mx -> Rabs y <= my ->
  let s := rnd (rnd (ux * x) + rnd (uy * y)) in
  let slack := rnd (rnd (rnd (cval c_height * rnd (rnd (Rabs ux * mx) + rnd (Rabs uy * my)))
    + rnd (cval c_height_cut * rnd (mx + my))) + cval c_tiny) in
  format mx -> format my ->
  rnd (s - slack) <= ux * x + uy * y - (27 * u * (Rabs ux * mx + Rabs uy * my) + 99 / 100 * cval c_height_cut * (mx + my)
    + 1000 * eta).
Proof.
  intros Pmx Pmy Hx Hy s slack Fx Fy. pose proof eta_pos as EP. pose proof tiny_eta as T.
  assert (C : cval c_height = 32 * u) by (unfold c_height, u; numerals; lra).
  assert (D : 0 < cval c_height_cut) by (unfold c_height_cut, cval; cbn [fst snd]; generalize (bpow_gt_0 radix2 (-898)); lra).
  assert (FT : format (cval c_tiny)) by (rewrite <- (proj2 (lit_correct c_tiny eq_refl)); apply val_format).
  assert (Rabs (ux * x) <= Rabs ux * mx) by (rewrite Rabs_mult; apply Rmult_le_compat_l; [apply Rabs_pos|exact Hx]).
  assert (Rabs (uy * y) <= Rabs uy * my) by (rewrite Rabs_mult; apply Rmult_le_compat_l; [apply Rabs_pos|exact Hy]).
  assert (Pa : 0 <= Rabs ux * mx) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pmx]).
  assert (Pb : 0 <= Rabs uy * my) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pmy]).
  set (a := Rabs ux * mx) in *. set (b := Rabs uy * my) in *. set (z := cval c_height_cut) in *.
  assert (A0 : a * (1 - u) - eta <= rnd a) by now apply rnd_lower.
  assert (B0 : b * (1 - u) - eta <= rnd b) by now apply rnd_lower.
  assert (A0' : 0 <= rnd a) by now apply rnd_pos. assert (B0' : 0 <= rnd b) by now apply rnd_pos.
  assert (A0u : rnd a <= a * (1 + u) + eta) by now apply rnd_upper.
  assert (B0u : rnd b <= b * (1 + u) + eta) by now apply rnd_upper.
  assert (M0 : (rnd a + rnd b) * (1 - u) <= rnd (rnd a + rnd b) <= (rnd a + rnd b) * (1 + u)).
  { split; [apply rnd_add_lower|apply rnd_add_upper]; try apply rnd_format; lra. }
  assert (Pq : 0 <= cval c_height * rnd (rnd a + rnd b)) by (rewrite C; apply Rmult_le_pos; unfold u in *; lra).
  assert (Q0 : cval c_height * rnd (rnd a + rnd b) * (1 - u) - eta <= rnd (cval c_height * rnd (rnd a + rnd b)) <=
    cval c_height * rnd (rnd a + rnd b) * (1 + u) + eta) by (split; [now apply rnd_lower|now apply rnd_upper]).
  rewrite C in Q0. unfold slack. rewrite C. set (q := rnd (32 * u * rnd (rnd a + rnd b))) in *.
  assert (N0 : (mx + my) * (1 - u) <= rnd (mx + my) <= (mx + my) * (1 + u)).
  { split; [apply rnd_add_lower|apply rnd_add_upper]; try assumption; lra. }
  assert (W0 : z * ((mx + my) * (1 - u)) <= z * rnd (mx + my) <= z * ((mx + my) * (1 + u))).
  { split; apply Rmult_le_compat_l; lra. }
  assert (Pz : 0 <= z * (mx + my)) by (apply Rmult_le_pos; lra).
  assert (Pw : 0 <= z * rnd (mx + my)) by (unfold u in *; lra).
  assert (V0 : z * rnd (mx + my) * (1 - u) - eta <= rnd (z * rnd (mx + my)) <= z * rnd (mx + my) * (1 + u) + eta)
    by (split; [now apply rnd_lower|now apply rnd_upper]).
  set (w := rnd (z * rnd (mx + my))) in *.
  assert (Pw' : 0 <= w) by now apply rnd_pos. assert (Pq' : 0 <= q) by (rewrite C in Pq; now apply rnd_pos).
  assert (S1 : (q + w) * (1 - u) <= rnd (q + w) <= (q + w) * (1 + u)).
  { split; [apply rnd_add_lower|apply rnd_add_upper]; try apply rnd_format; lra. }
  assert (T0 : 0 <= cval c_tiny) by lra.
  assert (S2 : (rnd (q + w) + cval c_tiny) * (1 - u) <= rnd (rnd (q + w) + cval c_tiny) <= (rnd (q + w) + cval c_tiny) * (1
    + u)).
  { split; [apply rnd_add_lower|apply rnd_add_upper]; try apply rnd_format; try exact FT; unfold u in *; lra. }
  set (k := rnd (rnd (q + w) + cval c_tiny)) in *.
  pose proof (rnd_error (ux * x)) as E1. pose proof (rnd_error (uy * y)) as E2.
  pose proof (rnd_add_error _ _ (rnd_format (ux * x)) (rnd_format (uy * y))) as E3. fold s in E3.
  pose proof (rnd_sub_error s k (rnd_format _) (rnd_format _)) as E4.
  apply Rabs_le_inv in E1. apply Rabs_le_inv in E2.
  assert (HX : Rabs (ux * x) <= a) by assumption. assert (HY : Rabs (uy * y) <= b) by assumption.
  pose proof (Rle_abs (ux * x)) as X1. pose proof (Rle_abs (- (ux * x))) as X2. rewrite Rabs_Ropp in X2.
  pose proof (Rle_abs (uy * y)) as Y1. pose proof (Rle_abs (- (uy * y))) as Y2. rewrite Rabs_Ropp in Y2.
  assert (E3' : Rabs (rnd (ux * x) + rnd (uy * y)) <= (a + b) * (1 + u) + 2 * eta) by (apply Rabs_le; unfold u in *; lra).
  assert (E3'' : Rabs (s - (rnd (ux * x) + rnd (uy * y))) <= u * ((a + b) * (1 + u) + 2 * eta)).
  { apply Rle_trans with (1 := E3). apply Rmult_le_compat_l; [unfold u; lra|exact E3']. }
  apply Rabs_le_inv in E3''.
  assert (E4' : Rabs (s - k) <= (a + b) * (1 + 3 * u) + 3 * eta + k) by (apply Rabs_le; unfold u in *; lra).
  assert (E4'' : Rabs (rnd (s - k) - (s - k)) <= u * ((a + b) * (1 + 3 * u) + 3 * eta + k)).
  { apply Rle_trans with (1 := E4). apply Rmult_le_compat_l; [unfold u; lra|exact E4']. }
  apply Rabs_le_inv in E4''.
  clear - EP T C D Pa Pb A0 B0 M0 Q0 N0 W0 Pz V0 S1 S2 E1 E2 HX HY E3'' E4'' X1 X2 Y1 Y2.
  set (zm := z * (mx + my)) in *.
  replace (z * ((mx + my) * (1 - u))) with (zm * (1 - u)) in W0 by (unfold zm; ring).
  replace (99 / 100 * z * (mx + my)) with (99 / 100 * zm) by (unfold zm; ring).
  rewrite T in *. unfold u in *. lra.
Qed.

Lemma lower_end_number f x : lower_end f x -> is_nan 53 1024 f = false.
Proof. intros [->|[F _]]; [reflexivity|]. destruct f; try discriminate; reflexivity. Qed.
Lemma upper_end_number f x : upper_end f x -> is_nan 53 1024 f = false.
Proof. intros [->|[F _]]; [reflexivity|]. destruct f; try discriminate; reflexivity. Qed.

Lemma farther_end_finite ux a b : finite a -> finite b -> finite (farther_end ux a b).
Proof. intros. unfold farther_end. now destruct (gt ux (lit c_zero)). Qed.
Lemma farther_end_size ux a b m : Rabs (val a) <= m -> Rabs (val b) <= m -> Rabs (val (farther_end ux a b)) <= m.
Proof. intros. unfold farther_end. now destruct (gt ux (lit c_zero)). Qed.

(** A finite slack: everything is finite, and so is the sum at a corner. *)
Lemma slack_finite ux uy mx my : finite (height_slack ux uy mx my) ->
  finite ux /\ finite uy /\ finite mx /\ finite my /\
  val (height_slack ux uy mx my) = rnd (rnd (rnd (cval c_height * rnd (rnd (Rabs (val ux) * val mx) + rnd (Rabs (val uy) *
    val my))) + rnd (cval c_height_cut * rnd (val mx + val my))) + cval c_tiny) /\
  forall px py, finite px -> finite py -> Rabs (val px) <= val mx -> Rabs (val py) <= val my ->
    finite (ux * px + uy * py)%D /\ val (ux * px + uy * py)%D = rnd (rnd (val ux * val px) + rnd (val uy * val py)).
Proof.
  intros K. unfold height_slack in *. destruct (fadd_inv _ _ K) as (K1 & _ & E1). destruct (fadd_inv _ _ K1) as (K2 & K3 &
    E2).
  destruct (fmul_inv _ _ K2) as (_ & K4 & E3). destruct (fmul_inv _ _ K3) as (_ & K5 & E4).
  destruct (fadd_inv _ _ K4) as (K6 & K7 & E5). destruct (fadd_inv _ _ K5) as (Fx & Fy & E6).
  destruct (fmul_inv _ _ K6) as (Gu & _ & E7). destruct (fmul_inv _ _ K7) as (Gv & _ & E8).
  rewrite fabs_finite in Gu, Gv. rewrite fabs_val in E7, E8.
  split; [exact Gu|]. split; [exact Gv|]. split; [exact Fx|]. split; [exact Fy|]. split.
  { rewrite E1, E2, E3, E4, E5, E6, E7, E8, (proj2 (lit_correct c_height eq_refl)),
      (proj2 (lit_correct c_height_cut eq_refl)), (proj2 (lit_correct c_tiny eq_refl)). reflexivity. }
  intros px py Fpx Fpy Hx Hy.
  assert (P : forall w m p, finite (fabs w * m)%D -> finite w -> val (fabs w * m)%D = rnd (Rabs (val w) * val m) ->
    finite p -> Rabs (val p) <= val m -> finite (w * p)%D /\ val (w * p)%D = rnd (val w * val p) /\
    Rabs (rnd (val w * val p)) <= val (fabs w * m)%D).
  { intros w m p F Fw E Fp H.
    assert (L : Rabs (rnd (val w * val p)) <= val (fabs w * m)%D).
    { rewrite E, <- rnd_abs, Rabs_mult. apply rnd_le, Rmult_le_compat_l; [apply Rabs_pos|exact H]. }
    destruct (fmul_finite w p Fw Fp) as [G V]; [|now split].
    apply Rle_lt_trans with (1 := L), Rle_lt_trans with (1 := Rle_abs _), val_lt_max. }
  destruct (P ux mx px K6 Gu E7 Fpx Hx) as (F1 & V1 & L1). destruct (P uy my py K7 Gv E8 Fpy Hy) as (F2 & V2 & L2).
  rewrite <- V1, <- V2. apply fadd_finite; try assumption. rewrite <- rnd_abs.
  apply Rle_lt_trans with (rnd (val (fabs ux * mx)%D + val (fabs uy * my)%D)).
  - apply rnd_le. rewrite <- V1 in L1. rewrite <- V2 in L2.
    generalize (Rabs_triang (val (ux * px)%D) (val (uy * py)%D)). lra.
  - rewrite <- E5. apply Rle_lt_trans with (1 := Rle_abs _), val_lt_max.
Qed.

Lemma height_slack_nneg ux uy a b c d : nneg (height_slack ux uy (fmax (fabs a) (fabs b)) (fmax (fabs c) (fabs d))).
Proof.
  assert (nn : forall a b, nneg (fmax (fabs a) (fabs b))) by (intros; unfold fmax; destruct (gt _ _); apply nneg_abs).
  unfold height_slack. repeat apply nneg_add; try (apply nneg_lit; [reflexivity|simpl; lia]); apply nneg_mul;
    try (apply nneg_lit; [reflexivity|simpl; lia]); apply nneg_add; try apply nn; (apply nneg_mul; [apply nneg_abs|apply nn]).
Qed.

(** Never NaN and never +inf; -inf, or below u.x at the corner of p by a margin. mx, my bound all coordinates. *)
Theorem height_lower_margin all ux uy p x y : in_box p all ->
  lower_end (e0 all) x -> upper_end (e1 all) x -> lower_end (e2 all) y -> upper_end (e3 all) y ->
  let px := farther_end ux (e0 p) (e1 p) in let py := farther_end uy (e2 p) (e3 p) in
  height_lower all ux uy p = ninf \/
  exists mx my, finite (height_lower all ux uy p) /\ finite ux /\ finite uy /\ finite px /\ finite py /\
    (forall z, lower_end (e0 all) z -> upper_end (e1 all) z -> Rabs z <= mx) /\
    (forall z, lower_end (e2 all) z -> upper_end (e3 all) z -> Rabs z <= my) /\
    Rabs (val px) <= mx /\ Rabs (val py) <= my /\
    val (height_lower all ux uy p) <= val ux * val px + val uy * val py
     - (27 * u * (Rabs (val ux) * mx + Rabs (val uy) * my) + 99 / 100 * cval c_height_cut * (mx + my) + 1000 * eta).
Proof.
  intros [(X1 & X2 & X3) (Y1 & Y2 & Y3)] L0 U0 L1 U1 px py. unfold height_lower. cbv zeta. fold px py.
  pose proof (height_slack_nneg ux uy (e0 all) (e1 all) (e2 all) (e3 all)) as N.
  set (mx := fmax (fabs (e0 all)) (fabs (e1 all))) in *. set (my := fmax (fabs (e2 all)) (fabs (e3 all))) in *.
  set (k := height_slack ux uy mx my) in *. set (s := (ux * px + uy * py)%D).
  destruct (is_nan 53 1024 (s - k)%D) eqn:Nh; [left; reflexivity|].
  destruct (cases k) as [K|[K|[K|K]]].
  - destruct (slack_finite _ _ _ _ K) as (Fu & Fv & Fx & Fy & Ek & Sum). fold k in Ek.
    destruct (size_of_ends _ _ (lower_end_number _ _ L0) (upper_end_number _ _ U0) Fx) as (F0 & F1 & S0 & S1).
    destruct (size_of_ends _ _ (lower_end_number _ _ L1) (upper_end_number _ _ U1) Fy) as (F2 & F3 & S2 & S3).
    fold mx in S0, S1. fold my in S2, S3.
    destruct (le_between _ _ _ _ F0 F1 X1 X2 X3) as [[P0 Q0] [P1 Q1]].
    destruct (le_between _ _ _ _ F2 F3 Y1 Y2 Y3) as [[P2 Q2] [P3 Q3]].
    assert (between : forall a z b m, Rabs a <= m -> Rabs b <= m -> a <= z <= b -> Rabs z <= m).
    { intros a z b m A B C. apply Rabs_le_inv in A. apply Rabs_le_inv in B. apply Rabs_le. lra. }
    assert (Fpx : finite px) by now apply farther_end_finite. assert (Fpy : finite py) by now apply farther_end_finite.
    assert (Hpx : Rabs (val px) <= val mx) by (apply farther_end_size; now apply (between _ _ _ _ S0 S1)).
    assert (Hpy : Rabs (val py) <= val my) by (apply farther_end_size; now apply (between _ _ _ _ S2 S3)).
    destruct (Sum px py Fpx Fpy Hpx Hpy) as [Fs Es]. fold s in Fs, Es.
    assert (inner : forall a b z m, finite a -> finite b -> lower_end a z -> upper_end b z -> Rabs (val a) <= m ->
      Rabs (val b) <= m -> Rabs z <= m).
    { intros a b z m Fa Fb La Ub A B. destruct La as [->|[_ La]]; [discriminate|]. destruct Ub as [->|[_ Ub]]; [discriminate|].
      now apply (between (val a) z (val b) m). }
    destruct (fsub_total s k Fs K) as [[F E]|[[_ A]|[E _]]].
    + right. exists (val mx), (val my). split; [exact F|]. repeat (split; [assumption|]).
      split; [intros z Lz Uz; exact (inner _ _ z _ F0 F1 Lz Uz S0 S1)|].
      split; [intros z Lz Uz; exact (inner _ _ z _ F2 F3 Lz Uz S2 S3)|].
      split; [exact Hpx|]. split; [exact Hpy|]. rewrite E, Es, Ek.
      assert (0 <= val mx) by (generalize (Rabs_pos (val px)); lra).
      assert (0 <= val my) by (generalize (Rabs_pos (val py)); lra).
      now apply height_rounding; try apply val_format.
    + exfalso. assert (rnd (val s - val k) <= val s).
      { rewrite <- (rnd_id (val s)) at 2 by apply val_format. apply rnd_le. generalize (nneg_val _ N). lra. }
      generalize (val_lt_max s) (Rle_abs (val s)). lra.
    + left. exact E.
  - exfalso. destruct k; try discriminate. destruct s; discriminate.
  - left. rewrite K in *. destruct s as [|[|]| |]; try discriminate; reflexivity.
  - rewrite K in N. discriminate.
Qed.

(** ** The comparison *)

(** (ux,uy) is about the exact direction (UX,UY). *)
Definition near_direction (w : double) (W : R) : Prop := Rabs (W - val w) <= 2 * u * Rabs W + cval c_height_cut / 4.

(** (xv,yv) is at most as far as (xk,yk) along the exact direction; the corner of p that counts is outside of (xv,yv) by
    at most a unit in the last place. b is the box of (xk,yk), or of a node above it. *)
Theorem beyond_visits all b p ux uy UX UY xk yk xv yv : in_box p all ->
  finite ux -> finite uy -> near_direction ux UX -> near_direction uy UY ->
  lower_end (e0 all) xk -> upper_end (e1 all) xk -> lower_end (e2 all) yk -> upper_end (e3 all) yk ->
  lower_end (e0 all) xv -> upper_end (e1 all) xv -> lower_end (e2 all) yv -> upper_end (e3 all) yv ->
  lower_end (e0 b) xk -> upper_end (e1 b) xk -> lower_end (e2 b) yk -> upper_end (e3 b) yk ->
  let px := farther_end ux (e0 p) (e1 p) in let py := farther_end uy (e2 p) (e3 p) in
  (finite px -> val ux * val px <= val ux * xv + Rabs (val ux) * (2 * u * Rabs (val px) + 2 * eta)) ->
  (finite py -> val uy * val py <= val uy * yv + Rabs (val uy) * (2 * u * Rabs (val py) + 2 * eta)) ->
  Rabs (val ux) <= 1 -> Rabs (val uy) <= 1 ->
  UX * xv + UY * yv <= UX * xk + UY * yk ->
  lt (reach b ux uy) (height_lower all ux uy p) = false.
Proof.
  intros I Fu Fv Nx Ny K0 K1 K2 K3 V0 V1 V2 V3 B0 B1 B2 B3 px py Ox Oy U1 U2 Less.
  destruct (lt (reach b ux uy) (height_lower all ux uy p)) eqn:L; [exfalso|reflexivity].
  destruct (reach_upper b ux uy xk yk Fu Fv B0 B1 B2 B3) as [R|[FR R]].
  { rewrite R in L. destruct (height_lower all ux uy p) as [|[|]| |]; discriminate. }
  destruct (height_lower_margin all ux uy p xk yk I K0 K1 K2 K3) as [H|(mx & my & FH & _ & _ & Fx & Fy & Sx & Sy & Px & Py &
    H)].
  { rewrite H in L. destruct (reach b ux uy) as [|[|]| |]; discriminate. }
  fold px in Fx, Px, H. fold py in Fy, Py, H. specialize (Ox Fx). specialize (Oy Fy).
  apply lt_finite in L; [|assumption..].
  pose proof (Sx xk K0 K1) as Xk. pose proof (Sy yk K2 K3) as Yk.
  pose proof (Sx xv V0 V1) as Xv. pose proof (Sy yv V2 V3) as Yv.
  set (z := cval c_height_cut) in *. pose proof eta_pos as EP.
  assert (Pz : 0 < z) by (unfold z, c_height_cut, cval; cbn [fst snd]; generalize (bpow_gt_0 radix2 (-898)); lra).
  assert (err : forall w W m t, near_direction w W -> 0 <= m -> Rabs t <= m ->
    Rabs ((W - val w) * t) <= 201 / 100 * u * (Rabs (val w) * m) + 26 / 100 * (z * m)).
  { intros w W m t Nw Pm Ht. unfold near_direction in Nw. fold z in Nw. rewrite Rabs_mult.
    assert (D : Rabs (W - val w) <= 201 / 100 * u * Rabs (val w) + 26 / 100 * z).
    { pose proof (Rabs_triang (val w) (W - val w)) as T. replace (val w + (W - val w)) with W in T by ring.
      pose proof (Rabs_pos (val w)). unfold u in *. lra. }
    apply Rle_trans with ((201 / 100 * u * Rabs (val w) + 26 / 100 * z) * m).
    - apply Rmult_le_compat; try apply Rabs_pos; assumption.
    - right; ring. }
  assert (Pmx : 0 <= mx) by (generalize (Rabs_pos xk); lra). assert (Pmy : 0 <= my) by (generalize (Rabs_pos yk); lra).
  pose proof (err ux UX mx xk Nx Pmx Xk) as E1. pose proof (err ux UX mx xv Nx Pmx Xv) as E2.
  pose proof (err uy UY my yk Ny Pmy Yk) as E3. pose proof (err uy UY my yv Ny Pmy Yv) as E4.
  apply Rabs_le_inv in E1. apply Rabs_le_inv in E2. apply Rabs_le_inv in E3. apply Rabs_le_inv in E4.
  assert (out : forall w m p, Rabs (val w) <= 1 -> 0 <= m -> Rabs p <= m ->
    Rabs (val w) * (2 * u * Rabs p + 2 * eta) <= 2 * u * (Rabs (val w) * m) + 2 * eta).
  { intros w m q Hw Pm Hp. pose proof (Rabs_pos (val w)).
    assert (Rabs (val w) * Rabs q <= Rabs (val w) * m) by (apply Rmult_le_compat_l; assumption).
    assert (Rabs (val w) * eta <= 1 * eta) by (apply Rmult_le_compat_r; lra). unfold u in *. lra. }
  pose proof (out ux mx (val px) U1 Pmx Px) as O1. pose proof (out uy my (val py) U2 Pmy Py) as O2.
  set (a := Rabs (val ux) * mx) in *. set (c := Rabs (val uy) * my) in *.
  assert (Pa : 0 <= a) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pmx]).
  assert (Pc : 0 <= c) by (apply Rmult_le_pos; [apply Rabs_pos|exact Pmy]).
  assert (Pzx : 0 <= z * mx) by (apply Rmult_le_pos; lra). assert (Pzy : 0 <= z * my) by (apply Rmult_le_pos; lra).
  replace (99 / 100 * z * (mx + my)) with (99 / 100 * (z * mx) + 99 / 100 * (z * my)) in H by ring.
  clear - EP R H L Ox Oy Less E1 E2 E3 E4 O1 O2 Pa Pc Pzx Pzy. unfold u in *. lra.
Qed.
