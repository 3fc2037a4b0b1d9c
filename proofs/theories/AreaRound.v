(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The sum of the turns as dyd_filter_shape makes it in doubles: where its checks pass, the polygon is as AreaStar.v asks,
   and the area counted is not above the exact one. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance.
From Dyadel Require FiltersOrient.
From Dyadel Require Import Plane Orientation AreaVoronoi AreaChains AreaStar.
Import ListNotations.
Open Scope R_scope.

(* A point with double coordinates. *)
Definition dpoint : Type := (double * double)%type.
Definition real (a : dpoint) : point := (val (fst a), val (snd a)).
Definition dfinite (a : dpoint) : Prop := finite (fst a) /\ finite (snd a).

(* [AREA-V] src/voronoi/shape_filter.c: *error = {} * (fabs(p) *)
Definition c_turn : const := (1, -50)%Z.
(* C src/voronoi/shape_filter.c double_turn
  double ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y, p = ax * by, q = ay * bx;
  *error = 8 * 0x1p-53 * (fabs(p) + fabs(q)) + DYD_TINY;
  return p - q;
*)
Definition turn_p (o a b : dpoint) : double := ((fst a - fst o) * (snd b - snd o))%D.
Definition turn_q (o a b : dpoint) : double := ((snd a - snd o) * (fst b - fst o))%D.
Definition turn_error (o a b : dpoint) : double :=
  (lit c_turn * (fabs (turn_p o a b) + fabs (turn_q o a b)) + lit c_tiny)%D.
Definition turn (o a b : dpoint) : double := (turn_p o a b - turn_q o a b)%D.

(* [AREA-V] src/voronoi/shape_filter.c: *error += e + {} * *area; *)
Definition c_turn_sum : const := (1, -51)%Z.
(* C src/voronoi/shape_filter.c shape_star
  int crossings = 0;
  *area = *error = 0;
  for (uint32_t t = 0; t < n; t++) {
    dyd_xy a = z[t], b = z[t + 1 == n ? 0 : t + 1];
    double e, d = double_turn(&e, o, a, b);
    if (!(d > e)) return false;
    crossings += a.y < o.y && b.y >= o.y;
    *area += d;
    *error += e + 4 * 0x1p-53 * *area;
  }
  return crossings == 1;
*)
Definition ge (x y : double) : bool := le y x.
Definition rise (o a b : dpoint) : nat := if (lt (snd a) (snd o) && ge (snd b) (snd o))%bool then 1%nat else 0%nat.
Fixpoint star_from (o : dpoint) (area error : double) (c : list dpoint) : option (double * double * nat) :=
  match c with
  | a :: ((b :: _) as r) =>
    let d := turn o a b in
    let e := turn_error o a b in
    let area' := (area + d)%D in
    let error' := (error + (e + lit c_turn_sum * area'))%D in
    if gt d e then
      match star_from o area' error' r with Some (x, y, n) => Some (x, y, (rise o a b + n)%nat) | None => None end
    else None
  | _ => Some (area, error, 0%nat)
  end.
Definition star (o z : dpoint) (l : list dpoint) : option (double * double * nat) :=
  star_from o (lit c_zero) (lit c_zero) (z :: l ++ [z]).

(* As dyd_filter_shape has it: *)
(* [AREA-V] src/voronoi/shape_filter.c: s->area[0] = dyd_max(dyd_lower((area - error) / {}), 0); *)
Definition c_shape_two : const := (2, 0)%Z.
(* The theorems hold wherever the vertices are, and whichever are omitted: *)
(* any src/voronoi/shape_filter.c: #define U {} *)
(* any src/voronoi/shape_filter.c: if (!(share < {})) return *)
(* any src/voronoi/shape_filter.c: for (double times = {}; *)
Definition counted_area (area error : double) : double := fmax (lower ((area - error) / lit c_shape_two)) (lit c_zero).

(* ---- one turn ---- *)

Definition rounded_turn (o a b : dpoint) : R := rnd (val (turn_p o a b) - val (turn_q o a b)).

Lemma nneg_turn_error o a b : nneg (turn_error o a b).
Proof.
  unfold turn_error. apply nneg_add; [apply nneg_mul; [now apply nneg_lit | apply nneg_add; apply nneg_abs] | now apply nneg_lit].
Qed.

Lemma turn_correct o a b : gt (turn o a b) (turn_error o a b) = true ->
  finite (turn_error o a b) /\ cval c_tiny / 2 <= val (turn_error o a b) < rounded_turn o a b /\
  Rabs (rounded_turn o a b - orient (real o) (real a) (real b)) <= 6 / 10 * val (turn_error o a b).
Proof.
  intros G. assert (F : finite (turn_error o a b)) by (now apply (gt_nneg_finite (turn o a b)); [apply nneg_turn_error |]).
  split; [exact F |]. pose proof F as F0. unfold turn_error in F0.
  destruct (fadd_inv _ _ F0) as (F1 & _ & V). destruct (fmul_inv _ _ F1) as (_ & F2 & V1).
  destruct (fadd_inv _ _ F2) as (F3 & F4 & V2). rewrite fabs_finite in F3, F4. rewrite !fabs_val in V2.
  unfold turn in G. apply (fsub_gt _ _ _ F3 F4 F) in G. fold (rounded_turn o a b) in G.
  unfold turn_p in F3. unfold turn_q in F4.
  destruct (fmul_inv _ _ F3) as (A1 & B1 & P). destruct (fmul_inv _ _ F4) as (A2 & B2 & Q).
  destruct (fsub_inv _ _ A1) as (_ & _ & X1). destruct (fsub_inv _ _ B1) as (_ & _ & Y1).
  destruct (fsub_inv _ _ A2) as (_ & _ & X2). destruct (fsub_inv _ _ B2) as (_ & _ & Y2).
  fold (turn_p o a b) in P. fold (turn_q o a b) in Q. rewrite X1, Y1 in P. rewrite X2, Y2 in Q.
  destruct (FiltersOrient.orient_error (val (fst a)) (val (snd a)) (val (fst b)) (val (snd b)) (val (fst o)) (val (snd o))
    (val_format _) (val_format _) (val_format _) (val_format _) (val_format _) (val_format _)) as [L [R E]].
  rewrite <- P in L, E. rewrite <- Q in R, E. fold (rounded_turn o a b) in E.
  assert (O : FiltersOrient.orient (val (fst a)) (val (snd a)) (val (fst b)) (val (snd b)) (val (fst o)) (val (snd o))
    = orient (real o) (real a) (real b)) by (unfold FiltersOrient.orient, orient, real; simpl; ring).
  rewrite O in E. destruct L as [_ L]. destruct R as [_ R].
  set (mp := Rabs (val (fst a) - val (fst o)) * Rabs (val (snd b) - val (snd o))) in *.
  set (mq := Rabs (val (snd a) - val (snd o)) * Rabs (val (fst b) - val (fst o))) in *.
  assert (Mp : 0 <= mp) by (apply Rmult_le_pos; apply Rabs_pos).
  assert (Mq : 0 <= mq) by (apply Rmult_le_pos; apply Rabs_pos).
  assert (Ap : Rabs ((val (fst a) - val (fst o)) * (val (snd b) - val (snd o))) = mp) by (unfold mp; now rewrite Rabs_mult).
  assert (Aq : Rabs ((val (snd a) - val (snd o)) * (val (fst b) - val (fst o))) = mq) by (unfold mq; now rewrite Rabs_mult).
  assert (K : (1 + u) ^ 3 - 1 <= 3.001 * u) by (unfold u; lra).
  pose proof eta_pos as EP. pose proof u_pos as UP.
  assert (Bp : mp * (1 - 3.001 * u) - eta <= Rabs (val (turn_p o a b))).
  { rewrite Rabs_minus_sym in L. pose proof (Rabs_triang_inv ((val (fst a) - val (fst o)) * (val (snd b) - val (snd o))) (val (turn_p o a b))).
    rewrite Ap in *. assert (((1 + u) ^ 3 - 1) * mp <= 3.001 * u * mp) by (apply Rmult_le_compat_r; lra). lra. }
  assert (Bq : mq * (1 - 3.001 * u) - eta <= Rabs (val (turn_q o a b))).
  { rewrite Rabs_minus_sym in R. pose proof (Rabs_triang_inv ((val (snd a) - val (snd o)) * (val (fst b) - val (fst o))) (val (turn_q o a b))).
    rewrite Aq in *. assert (((1 + u) ^ 3 - 1) * mq <= 3.001 * u * mq) by (apply Rmult_le_compat_r; lra). lra. }
  set (m := mp + mq) in *.
  pose proof (Rabs_pos (val (turn_p o a b))). pose proof (Rabs_pos (val (turn_q o a b))).
  assert (S2 : (m * (1 - 3.001 * u) - 2 * eta) * (1 - u) <= rnd (Rabs (val (turn_p o a b)) + Rabs (val (turn_q o a b)))).
  { apply Rle_trans with ((Rabs (val (turn_p o a b)) + Rabs (val (turn_q o a b))) * (1 - u)).
    - apply Rmult_le_compat_r; [unfold u; lra | unfold m; lra].
    - apply rnd_add_lower; [rewrite <- fabs_val; apply val_format | rewrite <- fabs_val; apply val_format | lra]. }
  rewrite <- V2 in S2. set (s := val (fabs (turn_p o a b) + fabs (turn_q o a b))%D) in *.
  assert (Ps : 0 <= s) by (rewrite V2; apply rnd_pos; lra).
  assert (C8 : cval c_turn = 8 * u) by (unfold u, c_turn; numerals; lra).
  rewrite (proj2 (lit_correct c_turn eq_refl)), C8 in V1.
  assert (S1 : 8 * u * s * (1 - u) - eta <= rnd (8 * u * s)) by (apply rnd_lower; unfold u; lra).
  rewrite <- V1 in S1.
  assert (P1 : 0 <= val (lit c_turn * (fabs (turn_p o a b) + fabs (turn_q o a b)))%D).
  { rewrite V1. apply rnd_pos. unfold u; lra. }
  set (w := val (lit c_turn * (fabs (turn_p o a b) + fabs (turn_q o a b)))%D) in *.
  destruct (lit_correct c_tiny eq_refl) as [Ft Vt]. rewrite Vt in V.
  pose proof tiny_eta as T.
  assert (S0 : (w + cval c_tiny) * (1 - u) <= rnd (w + cval c_tiny)).
  { apply rnd_add_lower; [unfold w; apply val_format | rewrite <- Vt; apply val_format | lra]. }
  rewrite <- V in S0. fold (turn_error o a b) in S0. fold m in E.
  clear - G E S0 S1 S2 P1 Ps T EP UP Mp Mq m s w.
  assert (Pm : 0 <= m) by (unfold m; lra). clearbody m s w. rewrite T in *.
  split.
  - split; [unfold u in *; lra | exact G].
  - unfold u in *. lra.
Qed.

(* ---- the sum ---- *)

(* One round of the loop in real numbers: a and e are the area and the error so far, s the exact sum. *)
Lemma step_correct k s a e d t x : format a -> format e -> format d -> format t -> 1 <= k <= 2 ->
  0 <= a -> 0 <= e <= k * a -> Rabs (s - a) <= e -> cval c_tiny / 2 <= t < d -> Rabs (d - x) <= 6 / 10 * t ->
  let a' := rnd (a + d) in
  let e' := rnd (e + rnd (t + rnd (4 * u * a'))) in
  0 <= a' /\ 0 <= e' <= (k + 22 * u) * a' /\ Rabs (s + x - a') <= e'.
Proof.
  intros Fa Fe Fd Ft K A E S T X a' e'. pose proof eta_pos as EP. pose proof u_pos as UP. pose proof tiny_eta as TE.
  rewrite TE in T. clear TE.
  assert (A1 : (a + d) * (1 - u) <= a') by (apply rnd_add_lower; try assumption; lra).
  assert (A2 : Rabs (a' - (a + d)) <= u * (a + d)).
  { rewrite <- (Rabs_pos_eq (a + d)) at 2 by lra. now apply rnd_add_error. }
  assert (Fa' : format a') by apply rnd_format.
  assert (Pa' : 0 <= a') by (apply rnd_pos; lra).
  assert (Pu : 0 <= u * a') by (apply Rmult_le_pos; lra).
  set (y := rnd (4 * u * a')) in *.
  assert (Y1 : 4 * u * a' * (1 - u) - eta <= y) by (apply rnd_lower; lra).
  assert (Y2 : y <= 4 * u * a' * (1 + u) + eta) by (apply rnd_upper; lra).
  assert (Y0 : 0 <= y) by (apply rnd_pos; lra). assert (Fy : format y) by apply rnd_format.
  set (w := rnd (t + y)) in *.
  assert (W1 : (t + y) * (1 - u) <= w) by (apply rnd_add_lower; try assumption; lra).
  assert (W2 : w <= (t + y) * (1 + u)) by (apply rnd_add_upper; try assumption; lra).
  assert (W0 : 0 <= w) by (apply rnd_pos; lra). assert (Fw : format w) by apply rnd_format.
  assert (E1 : (e + w) * (1 - u) <= e') by (apply rnd_add_lower; try assumption; lra).
  assert (E2 : e' <= (e + w) * (1 + u)) by (apply rnd_add_upper; try assumption; lra).
  assert (E0 : 0 <= e') by (apply rnd_pos; lra).
  clearbody e' w y a'. clear Fa Fe Fd Ft Fa' Fy Fw.
  set (v := u * a') in *.
  assert (H1 : eta <= v).
  { unfold v. assert (t * (1 - u) <= (a + d) * (1 - u)) by (apply Rmult_le_compat_r; unfold u; lra). unfold u in *. lra. }
  assert (H2 : u * (a + d) <= 1.001 * v) by (unfold v, u in *; lra).
  assert (Ea : e <= 2 * a) by (apply Rle_trans with (k * a); [lra | apply Rmult_le_compat_r; lra]).
  split; [exact Pa' |]. split; [split; [exact E0 |] |].
  - assert (Z : k * (a + d) * (1 - u) <= k * a') by (rewrite Rmult_assoc; apply Rmult_le_compat_l; lra).
    assert (Z0 : 1 * d <= k * d) by (apply Rmult_le_compat_r; lra). assert (Z1 : e + t <= k * (a + d)) by lra.
    assert (Z2 : k * (a + d) <= 2 * (a + d)) by (apply Rmult_le_compat_r; lra).
    apply Rle_trans with (1 := E2). unfold v, u in *. lra.
  - replace (s + x - a') with ((s - a) + (- (d - x) + - (a' - (a + d)))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _).
    assert (Rabs (- (d - x) + - (a' - (a + d))) <= 6 / 10 * t + 1.001 * v).
    { apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_Ropp. lra. }
    assert (u * e <= 2.002 * v) by (unfold v, u in *; lra).
    unfold v, u in *. lra.
Qed.

Lemma star_finite o c : forall area error x y n, star_from o area error c = Some (x, y, n) -> finite x -> finite y ->
  finite area /\ finite error.
Proof.
  induction c as [| a c IH]; intros area error x y n; [intros [= -> -> _]; tauto |].
  destruct c as [| b c]; [intros [= -> -> _]; tauto |].
  change (star_from o area error (a :: b :: c)) with
    (let area' := (area + turn o a b)%D in
     let error' := (error + (turn_error o a b + lit c_turn_sum * area'))%D in
     if gt (turn o a b) (turn_error o a b) then
       match star_from o area' error' (b :: c) with Some (x, y, n) => Some (x, y, (rise o a b + n)%nat) | None => None end
     else None). cbv zeta.
  destruct (gt (turn o a b) (turn_error o a b)); [| discriminate].
  destruct (star_from o _ _ (b :: c)) as [[[x' y'] n'] |] eqn:E; [| discriminate]. intros [= -> -> _] Fx Fy.
  destruct (IH _ _ _ _ _ E Fx Fy) as [A B]. split; [apply (fadd_inv _ _ A) | apply (fadd_inv _ _ B)].
Qed.

Lemma star_sum o c : forall k s area error x y n, star_from o area error c = Some (x, y, n) -> finite x -> finite y ->
  1 <= k -> k + 22 * u * INR (length c) <= 2 -> 0 <= val area -> 0 <= val error <= k * val area ->
  Rabs (s - val area) <= val error ->
  Rabs (s + fan_area2 (real o) (map real c) - val x) <= val y.
Proof.
  induction c as [| a c IH]; intros k s area error x y n; [intros [= -> -> _]; simpl; intros; now rewrite Rplus_0_r |].
  destruct c as [| b c]; [intros [= -> -> _]; simpl; intros; now rewrite Rplus_0_r |].
  change (star_from o area error (a :: b :: c)) with
    (let area' := (area + turn o a b)%D in
     let error' := (error + (turn_error o a b + lit c_turn_sum * area'))%D in
     if gt (turn o a b) (turn_error o a b) then
       match star_from o area' error' (b :: c) with Some (x, y, n) => Some (x, y, (rise o a b + n)%nat) | None => None end
     else None). cbv zeta.
  destruct (gt (turn o a b) (turn_error o a b)) eqn:G; [| discriminate].
  destruct (star_from o _ _ (b :: c)) as [[[x' y'] n'] |] eqn:E; [| discriminate].
  intros [= -> -> _] Fx Fy K1 K2 A1 A2 S.
  destruct (star_finite _ _ _ _ _ _ _ E Fx Fy) as [Fa Fe].
  destruct (fadd_inv _ _ Fa) as (Fa0 & Fd & Va). destruct (fadd_inv _ _ Fe) as (Fe0 & Fs & Ve).
  destruct (fadd_inv _ _ Fs) as (Ft & Fm & Vs). destruct (fmul_inv _ _ Fm) as (_ & _ & Vm).
  destruct (turn_correct o a b G) as [_ [T1 T2]]. unfold turn in Fd. destruct (fsub_inv _ _ Fd) as (_ & _ & Vd).
  fold (turn o a b) in Vd, Fd. fold (rounded_turn o a b) in Vd. rewrite <- Vd in T1, T2.
  assert (C4 : cval c_turn_sum = 4 * u) by (unfold u, c_turn_sum; numerals; lra).
  rewrite (proj2 (lit_correct c_turn_sum eq_refl)), C4 in Vm.
  assert (Kc : k <= 2). { assert (0 <= INR (length (a :: b :: c))) by apply pos_INR. pose proof u_pos. nra. }
  destruct (step_correct k s (val area) (val error) (val (turn o a b)) (val (turn_error o a b))
    (orient (real o) (real a) (real b)) (val_format _) (val_format _) (val_format _) (val_format _) (conj K1 Kc) A1 A2 S T1 T2)
    as [P1 [P2 P3]].
  rewrite <- Va in P1, P2, P3. rewrite <- Vm in P2, P3. rewrite <- Vs in P2, P3. rewrite <- Ve in P2, P3.
  change (fan_area2 (real o) (map real (a :: b :: c))) with
    (orient (real o) (real a) (real b) + fan_area2 (real o) (map real (b :: c))). rewrite <- Rplus_assoc.
  apply (IH (k + 22 * u) (s + orient (real o) (real a) (real b)) _ _ x y n' E Fx Fy); try assumption.
  - pose proof u_pos. lra.
  - change (length (a :: b :: c)) with (Datatypes.S (length (b :: c))) in K2. rewrite S_INR in K2. lra.
Qed.

(* ---- what the checks mean ---- *)

Lemma turn_finite o a b : finite (turn_error o a b) -> dfinite o /\ dfinite a /\ dfinite b.
Proof.
  intros F. unfold turn_error in F. destruct (fadd_inv _ _ F) as (F1 & _ & _). destruct (fmul_inv _ _ F1) as (_ & F2 & _).
  destruct (fadd_inv _ _ F2) as (F3 & F4 & _). rewrite fabs_finite in F3, F4. unfold turn_p, turn_q in *.
  destruct (fmul_inv _ _ F3) as (A1 & B1 & _). destruct (fmul_inv _ _ F4) as (A2 & B2 & _).
  destruct (fsub_inv _ _ A1) as (? & ? & _). destruct (fsub_inv _ _ B1) as (? & ? & _).
  destruct (fsub_inv _ _ A2) as (? & ? & _). destruct (fsub_inv _ _ B2) as (? & ? & _). unfold dfinite. tauto.
Qed.

Lemma star_checks o c : forall area error x y n, star_from o area error c = Some (x, y, n) ->
  left_round (real o) (map real c) /\ crossings (real o) (map real c) = n.
Proof.
  induction c as [| a c IH]; intros area error x y n; [intros [= _ _ <-]; now split |].
  destruct c as [| b c]; [intros [= _ _ <-]; now split |].
  change (star_from o area error (a :: b :: c)) with
    (let area' := (area + turn o a b)%D in
     let error' := (error + (turn_error o a b + lit c_turn_sum * area'))%D in
     if gt (turn o a b) (turn_error o a b) then
       match star_from o area' error' (b :: c) with Some (x, y, n) => Some (x, y, (rise o a b + n)%nat) | None => None end
     else None). cbv zeta.
  destruct (gt (turn o a b) (turn_error o a b)) eqn:G; [| discriminate].
  destruct (star_from o _ _ (b :: c)) as [[[x' y'] n'] |] eqn:E; [| discriminate]. intros [= _ _ <-].
  destruct (IH _ _ _ _ _ E) as [L R]. destruct (turn_correct o a b G) as [F [T1 T2]].
  destruct (turn_finite o a b F) as [[_ Oy] [[_ Ay] [_ By]]]. split.
  - split; [| exact L]. apply Rabs_le_inv in T2. pose proof tiny_eta. pose proof eta_pos. lra.
  - change (map real (a :: b :: c)) with (real a :: real b :: map real c). rewrite crossings_cons.
    change (real b :: map real c) with (map real (b :: c)). rewrite R. f_equal. unfold rises, rise, ge. simpl.
    pose proof (lt_finite (snd a) (snd o) Ay Oy) as La. pose proof (le_finite (snd o) (snd b) Oy By) as Lb.
    destruct (lt (snd a) (snd o)); destruct (Rlt_dec (val (snd a)) (val (snd o))) as [X | X]; simpl;
      try (exfalso; apply X, La; reflexivity); try (exfalso; apply La in X; discriminate); try reflexivity.
    destruct (le (snd o) (snd b)); destruct (Rle_dec (val (snd o)) (val (snd b))) as [Y | Y]; try reflexivity;
      [exfalso; apply Y, Lb; reflexivity | exfalso; apply Lb in Y; discriminate].
Qed.

Lemma positive_turn o a b : gt (turn o a b) (turn_error o a b) = true -> nneg (turn o a b).
Proof.
  intros G. pose proof (nneg_turn_error o a b) as N. pose proof (gt_nneg_finite _ _ N G) as F.
  destruct (is_finite 53 1024 (turn o a b)) eqn:K.
  - apply nneg_of_val; [exact K |]. apply gt_finite in G; [| exact K | exact F]. pose proof (nneg_val _ N). lra.
  - destruct (turn o a b) as [s | [|] | s p H | s m e H]; try discriminate K; try exact I; try reflexivity.
    destruct (turn_error o a b); discriminate.
Qed.

(* ---- the area counted ---- *)

Lemma half x : is_finite 53 1024 (x / lit c_shape_two)%D = is_finite 53 1024 x /\
  val (x / lit c_shape_two)%D = rnd (val x / 2).
Proof.
  destruct (lit_correct c_shape_two eq_refl) as [_ V]. assert (C : cval c_shape_two = 2) by (unfold c_shape_two; numerals; ring). rewrite C in V.
  generalize (Bdiv_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) binop_nan_pl64 mode_NE x (lit c_shape_two)).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE.
  fold (b64_div mode_NE x (lit c_shape_two)). change (b64_div mode_NE x (lit c_shape_two)) with (x / lit c_shape_two)%D.
  rewrite V. rewrite Rlt_bool_true.
  - intros H. destruct H as (A & B & _); [lra | now split].
  - rewrite <- rnd_abs. apply Rle_lt_trans with (Rabs (val x)); [| apply val_lt_max].
    rewrite <- (rnd_id (Rabs (val x))) by (rewrite <- fabs_val; apply val_format). apply rnd_le.
    unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra. pose proof (Rabs_pos (val x)). lra.
Qed.

(* The last error is nowhere negative; where it is finite, so is the area. *)
Lemma star_ends o a b c : forall area error x y n, nneg error -> nneg area -> star_from o area error (a :: b :: c) = Some (x, y, n) ->
  nneg y /\ (finite y -> finite x /\ 0 <= val x).
Proof.
  revert a b. induction c as [| d c IH]; intros a b area error x y n Ne Na.
  - change (star_from o area error [a; b]) with
      (let area' := (area + turn o a b)%D in
       let error' := (error + (turn_error o a b + lit c_turn_sum * area'))%D in
       if gt (turn o a b) (turn_error o a b) then Some (area', error', (rise o a b + 0)%nat) else None). cbv zeta.
    destruct (gt (turn o a b) (turn_error o a b)) eqn:G; [| discriminate]. intros [= <- <- _].
    pose proof (positive_turn o a b G) as Nd. assert (N : nneg (area + turn o a b)%D) by (now apply nneg_add).
    split.
    + apply nneg_add; [exact Ne |]. apply nneg_add; [apply nneg_turn_error |]. apply nneg_mul; [now apply nneg_lit | exact N].
    + intros F. destruct (fadd_inv _ _ F) as (_ & F1 & _). destruct (fadd_inv _ _ F1) as (_ & F2 & _).
      destruct (fmul_inv _ _ F2) as (_ & F3 & _). split; [exact F3 | now apply nneg_val].
  - change (star_from o area error (a :: b :: d :: c)) with
      (let area' := (area + turn o a b)%D in
       let error' := (error + (turn_error o a b + lit c_turn_sum * area'))%D in
       if gt (turn o a b) (turn_error o a b) then
         match star_from o area' error' (b :: d :: c) with Some (x, y, n) => Some (x, y, (rise o a b + n)%nat) | None => None end
       else None). cbv zeta.
    destruct (gt (turn o a b) (turn_error o a b)) eqn:G; [| discriminate].
    destruct (star_from o _ _ (b :: d :: c)) as [[[x' y'] n'] |] eqn:E; [| discriminate]. intros [= <- <- _].
    pose proof (positive_turn o a b G) as Nd. assert (N : nneg (area + turn o a b)%D) by (now apply nneg_add).
    refine (IH b d _ _ x' y' n' _ N E).
    apply nneg_add; [exact Ne |]. apply nneg_add; [apply nneg_turn_error |]. apply nneg_mul; [now apply nneg_lit | exact N].
Qed.

Lemma rnd_neg x : x <= 0 -> rnd x <= 0.
Proof. intros H. rewrite <- (round_0 radix2 fexp ZnearestE). now apply rnd_le. Qed.

Lemma ninf_mul_pos y : finite y -> 0 < val y -> (ninf * y)%D = ninf.
Proof.
  intros F P. destruct y as [s | s | s p H | [|] m e H]; try discriminate F; [simpl in P; lra | | reflexivity].
  exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in P. lra.
Qed.

(* Only a positive number, or infinity, has a positive lower bound. *)
Lemma positive_lower h : gt (lower h) (lit c_zero) = true -> h = inf \/ (finite h /\ 0 < val h).
Proof.
  unfold lower. cbv zeta. destruct (lit_correct c_cut eq_refl) as [Fc Vc]. destruct (lit_correct c_tiny eq_refl) as [Ft Vt].
  destruct (lit_correct c_down_factor eq_refl) as [Fd Vd]. destruct zero_lit as [Fz Vz].
  pose proof factor_down as D. pose proof tiny_eta as T. pose proof cut_W as C. pose proof eta_pos as EP.
  intros H. set (y := (h * lit c_down_factor - lit c_tiny)%D) in *.
  assert (G : gt y (lit c_zero) = true).
  { destruct (gt y (lit c_cut)) eqn:K; [| exact H]. destruct (is_finite 53 1024 y) eqn:Fy.
    - apply gt_finite; [exact Fy | exact Fz |]. apply gt_finite in K; try assumption. lra.
    - destruct y as [s | [|] | s p Hp | s m e Hm]; try discriminate Fy; clear - K Fc Fz;
        destruct (lit c_cut); try discriminate; destruct (lit c_zero); try discriminate; try reflexivity. }
  clear H. destruct (is_finite 53 1024 h) eqn:Fh.
  - right. split; [reflexivity |]. apply Rnot_le_lt. intros N. unfold y in G.
    assert (Q : finite (h * lit c_down_factor)%D /\ val (h * lit c_down_factor)%D = rnd (val h * val (lit c_down_factor))).
    { apply fmul_finite; try assumption. rewrite Vd, <- rnd_abs.
      apply Rle_lt_trans with (rnd (Rabs (val h))); [| rewrite rnd_id; [apply val_lt_max | rewrite <- fabs_val; apply val_format]].
      apply rnd_le. rewrite Rabs_mult, (Rabs_pos_eq (cval _)) by (unfold u in D; lra).
      rewrite <- (Rmult_1_r (Rabs (val h))) at 2. apply Rmult_le_compat_l; [apply Rabs_pos | unfold u in D; lra]. }
    destruct Q as [Q E]. apply (fsub_gt _ _ _ Q Ft Fz) in G. rewrite E, Vt, Vz, Vd in G.
    assert (rnd (val h * cval c_down_factor) <= 0).
    { apply rnd_neg.
      assert (0 <= (- val h) * cval c_down_factor) by (apply Rmult_le_pos; unfold u in D; lra). lra. }
    assert (rnd (rnd (val h * cval c_down_factor) - cval c_tiny) <= 0)
      by (apply rnd_neg; lra). lra.
  - left. destruct h as [s | [|] | s p Hp | s m e Hm]; try discriminate Fh; try reflexivity; exfalso; unfold y in G;
      clear - G Ft Fd Fz Vd D.
    + rewrite ninf_mul_pos in G; [| exact Fd | rewrite Vd; unfold u in D; lra].
      rewrite (ninf_sub _ Ft) in G. destruct (lit c_zero); discriminate.
    + destruct (lit c_down_factor); destruct (lit c_tiny), (lit c_zero); discriminate G.
Qed.

(* An error that is not finite leaves nothing to count. *)
Lemma nothing_of_infinity x y : nneg y -> is_finite 53 1024 y = false -> ((x - y) / lit c_shape_two)%D <> inf.
Proof.
  intros N F. destruct (lit_correct c_shape_two eq_refl) as [F2 V2]. assert (C : cval c_shape_two = 2) by (unfold c_shape_two; numerals; ring).
  assert (S2 : exists m e H, lit c_shape_two = B754_finite 53 1024 false m e H).
  { destruct (lit c_shape_two) as [s | s | s p H | [|] m e H]; try discriminate F2; try (simpl in V2; lra).
    - exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in V2. lra.
    - now exists m, e, H. }
  destruct S2 as [m [e [H ->]]]. clear - N F.
  destruct y as [s | s | s p Hp | s m' e' Hm]; try discriminate F; simpl in N.
  - subst s. destruct x as [t | [|] | t q Hq | t k f Hk]; discriminate.
  - destruct x as [t | [|] | t q Hq | t k f Hk]; discriminate.
Qed.

Lemma fan_area2_nonneg o c : left_round o c -> 0 <= fan_area2 o c.
Proof.
  induction c as [| a c IH]; [simpl; lra |]. destruct c as [| b c]; [simpl; lra |]. intros [H L].
  change (0 <= orient o a b + fan_area2 o (b :: c)). specialize (IH L). lra.
Qed.

Lemma counted_correct x y s : nneg y -> (finite y -> finite x /\ 0 <= val x) -> 0 <= s ->
  (finite x -> finite y -> Rabs (s - val x) <= val y) -> counted_area x y <> inf /\ val (counted_area x y) <= s / 2.
Proof.
  intros Ny Nx P0 Sum. unfold counted_area, fmax. set (h := ((x - y) / lit c_shape_two)%D).
  destruct zero_lit as [Fz Vz]. destruct (gt (lower h) (lit c_zero)) eqn:G.
  2: { split; [intros X; rewrite X in Fz; discriminate | rewrite Vz; lra]. }
  destruct (is_finite 53 1024 y) eqn:Fy.
  2: { exfalso. destruct (positive_lower h G) as [X | [F _]].
       - now apply (nothing_of_infinity x y).
       - unfold h in F. rewrite (proj1 (half (x - y)%D)) in F. apply fsub_inv in F. destruct F as (_ & F & _).
         rewrite F in Fy. discriminate. }
  destruct (Nx eq_refl) as [Fx Px]. pose proof (nneg_val _ Ny) as Py. specialize (Sum Fx eq_refl).
  destruct (fsub_finite x y Fx Fy) as [Fd Vd].
  { apply Rabs_lt. pose proof (val_lt_max x) as Wx. pose proof (val_lt_max y) as Wy.
    rewrite (Rabs_pos_eq (val x)) in Wx by exact Px. rewrite (Rabs_pos_eq (val y)) in Wy by exact Py. split.
    - apply Rlt_le_trans with (- val y); [lra |]. rewrite <- (rnd_id (- val y)) by (apply format_opp, val_format).
      apply rnd_le. lra.
    - apply Rle_lt_trans with (val x); [| exact Wx]. rewrite <- (rnd_id (val x)) at 2 by apply val_format. apply rnd_le. lra. }
  destruct (half (x - y)%D) as [Fh Vh]. fold h in Fh, Vh. rewrite Fd in Fh. rewrite Vd in Vh.
  assert (Ph : 0 < val h).
  { destruct (positive_lower h G) as [X | [_ H]]; [rewrite X in Fh; discriminate | exact H]. }
  pose proof eta_pos as EP. pose proof u_pos as UP. apply Rabs_le_inv in Sum.
  assert (Pd : 0 <= val x - val y).
  { apply Rnot_lt_le. intros N. pose proof (rnd_neg (val x - val y)). pose proof (rnd_neg (rnd (val x - val y) / 2)). lra. }
  assert (V1 : rnd (val x - val y) <= (val x - val y) * (1 + u)).
  { apply (rnd_add_upper (val x) (- val y)); [apply val_format | apply format_opp, val_format | exact Pd]. }
  assert (V2 : val h <= rnd (val x - val y) / 2 * (1 + u) + eta).
  { rewrite Vh. apply rnd_upper. pose proof (rnd_pos _ Pd). lra. }
  destruct (lower_correct h (s / 2)) as [NI L]; [lra | |].
  { left. split; [exact Fh |]. split; [lra |]. apply Rle_trans with (1 := V2).
    assert ((val x - val y) * (1 + u) <= s * (1 + u)) by (apply Rmult_le_compat_r; lra).
    assert (rnd (val x - val y) / 2 * (1 + u) <= s * (1 + u) / 2 * (1 + u)) by (apply Rmult_le_compat_r; lra).
    assert (s * (1 + u) / 2 * (1 + u) <= s / 2 * (1 + 62 / 10 * u)).
    { replace (s * (1 + u) / 2 * (1 + u)) with (s / 2 * ((1 + u) * (1 + u))) by field.
      apply Rmult_le_compat_l; [lra | unfold u; lra]. }
    lra. }
  split; [exact NI |]. apply L. clear - G NI Fz. destruct (lower h) as [t | [|] | t q Hq | t k f Hk]; try reflexivity.
  - exfalso. destruct (lit c_zero); discriminate.
  - now elim NI.
  - exfalso. destruct (lit c_zero); discriminate.
Qed.

(* [AREA-V] in doubles: if the loop ends with one crossing, the polygon is as star_polygon_inner asks, and the area
   counted for it is not above the exact one. The list may have 2^48 vertices. *)
Theorem star_counted o z l area error : star o z l = Some (area, error, 1%nat) ->
  22 * u * INR (length (z :: l ++ [z])) <= 1 ->
  let c := real z :: map real l ++ [real z] in
  left_round (real o) c /\ crossings (real o) c = 1%nat /\
  counted_area area error <> inf /\ val (counted_area area error) <= fan_area2 (real o) c / 2.
Proof.
  intros E N c. unfold star in E. assert (C : map real (z :: l ++ [z]) = c) by (simpl; now rewrite map_app).
  destruct (star_checks _ _ _ _ _ _ _ E) as [L R]. rewrite C in L, R. split; [exact L |]. split; [exact R |].
  destruct zero_lit as [Fz Vz].
  assert (Ends : nneg error /\ (finite error -> finite area /\ 0 <= val area)).
  { destruct l as [| b l]; simpl app in E; (eapply star_ends; [| | exact E]); now apply nneg_lit. }
  destruct Ends as [Ne Na]. apply counted_correct; [exact Ne | exact Na | now apply fan_area2_nonneg |].
  intros Fa Fe. rewrite <- C. rewrite <- (Rplus_0_l (fan_area2 _ _)).
  apply (star_sum o (z :: l ++ [z]) 1 0 (lit c_zero) (lit c_zero) area error 1%nat E Fa Fe); rewrite ?Vz; try lra.
  rewrite Rminus_0_r, Rabs_R0. lra.
Qed.
