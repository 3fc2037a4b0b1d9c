(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-STAR] The distances that star_filter.c compares, in doubles: radii, the disc of an edge, the sites outside of
    it; overflow, underflow and NaN included. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz List.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersIncircle FiltersIncircleAt
  FiltersDistance FiltersMeaning FiltersInterval FiltersIntervalSign FiltersNearRound FiltersDirectionBox.
From Dyadel Require Import Plane Distance.
Open Scope R_scope.

(** ** Squares of distances between doubles, from both sides *)

Lemma square_bounds a c : finite a -> finite c -> let X := val a - val c in let s := ((a - c) * (a - c))%D in
  upb s (X * X * (1 - 31 / 10 * u) - eta) /\ lob s (X * X * (1 + 31 / 10 * u) + eta).
Proof.
  intros Fa Fc X s. pose proof eta_pos as EP. pose proof W_big as WB. pose proof eta_323 as H323.
  assert (XX : 0 <= X * X) by apply Rle_0_sqr.
  assert (Big : bpow radix2 1024 <= Rabs (rnd X) -> W / 2 <= X * X * (1 + 31 / 10 * u) + eta).
  { intros H. pose proof (rnd_error X) as E. pose proof (Rabs_triang X (rnd X - X)) as T.
    replace (X + (rnd X - X)) with (rnd X) in T by ring.
    assert (S : W / 2 <= Rabs X) by (unfold u in *; lra).
    assert (W / 2 * (W / 2) <= Rabs X * Rabs X) by (apply Rmult_le_compat; lra).
    assert (Q : Rabs X * Rabs X = X * X) by (rewrite <- Rabs_mult; now apply Rabs_pos_eq).
    assert (W / 2 * 1 <= W / 2 * (W / 2)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= X * X * (31 / 10 * u)) by (apply Rmult_le_pos; [exact XX|unfold u; lra]). lra. }
  destruct (fsub_total a c Fa Fc) as [[F E]|[[E A]|[E A]]].
  - pose proof (diff_sub a c F) as D. fold X in D.
    pose proof (app_mul0 1 1 _ _ _ _ _ _ D D) as P. rewrite <- Rabs_mult, (Rabs_pos_eq (X * X)) in P by exact XX.
    destruct P as [_ P]. apply Rabs_le_inv in P.
    assert (K : ((1 + u) ^ 3 - 1) * (X * X) <= 31 / 10 * u * (X * X)) by (apply Rmult_le_compat_r; [exact XX|unfold u; lra]).
    assert (P0 : 0 <= rnd (val (a - c)%D * val (a - c)%D)) by (apply rnd_pos, Rle_0_sqr).
    change (S (1 + 1)) with 3%nat in P.
    destruct (fsqr_total _ F) as [[G V]|[G B]]; fold s in G.
    + fold s in V. split; [right|left]; rewrite <- V in *; (split; [exact G|]); lra.
    + split; [left; exact G|]. right. split; [exact G|]. lra.
  - assert (G : s = inf) by (unfold s; rewrite E; apply inf_sqr). split; [now left|]. right. split; [exact G|]. apply Big.
    fold X in A. apply Rle_trans with (1 := A), Rle_abs.
  - assert (G : s = inf) by (unfold s; rewrite E; reflexivity). split; [now left|]. right. split; [exact G|]. apply Big.
    fold X in A. rewrite Rabs_left1; [lra|]. generalize (bpow_gt_0 radix2 1024). lra.
Qed.

Lemma lift_bounds ax ay cx cy : finite ax -> finite ay -> finite cx -> finite cy ->
  let D := dist2 (val cx, val cy) (val ax, val ay) in
  upb (lift (ax - cx) (ay - cy)) (D * (1 - 62 / 10 * u) - 4 * eta) /\
  lob (lift (ax - cx) (ay - cy)) (D * (1 + 62 / 10 * u) + 4 * eta).
Proof.
  intros Fax Fay Fcx Fcy D. pose proof eta_pos as EP.
  destruct (square_bounds ax cx Fax Fcx) as [U1 L1]. destruct (square_bounds ay cy Fay Fcy) as [U2 L2].
  pose proof (upb_add _ _ _ _ U1 U2) as U. pose proof (lob_add _ _ _ _ L1 L2) as L.
  set (X := val ax - val cx) in *. set (Y := val ay - val cy) in *.
  assert (E : D = X * X + Y * Y) by (unfold D, dist2, X, Y; cbn [fst snd]; ring).
  assert (XX : 0 <= X * X) by apply Rle_0_sqr. assert (YY : 0 <= Y * Y) by apply Rle_0_sqr.
  unfold lift. rewrite E. split.
  - destruct U as [U|[F [P V]]]; [now left|right]. split; [exact F|]. split; [exact P|]. unfold u in *; lra.
  - destruct L as [[F [P V]]|[I V]]; [left|right]; (split; [assumption|]); unfold u in *; lra.
Qed.

(** ** Radii *)

(* C src/legal/star_filter.c star_radius
  dyd_xy p = sk->reps.xy[v];
  dyd_bbox c = {{p.x, p.x, p.y, p.y}};
  return sqrt(dyd_dl2_upper(&c, &sk->rects.box[v])) * DYD_UP_FACTOR + DYD_TINY;
*)
Definition point_box (x y : double) : bbox := {| e0 := x; e1 := x; e2 := y; e3 := y |}.
Definition radius (px py : double) (b : bbox) : double :=
  (fsqrt (dl2_upper (point_box px py) b) * lit c_up_factor + lit c_tiny)%D.

Lemma tiny_value : 9 / 10 ^ 302 <= cval c_tiny.
Proof.
  unfold c_tiny, cval, fst, snd. apply Rmult_le_reg_r with (bpow radix2 1000); [apply bpow_gt_0|].
  rewrite Rmult_1_l, <- bpow_plus. change (bpow radix2 (-1000 + 1000)) with 1. numerals. lra.
Qed.

Lemma root_up r d : 0 <= d -> d * d <= val r -> finite (fsqrt r * lit c_up_factor)%D ->
  d * (1 + 7 * u) - 3 * eta <= val (fsqrt r * lit c_up_factor)%D.
Proof.
  intros Pd H F. destruct (fmul_inv _ _ F) as (F1 & _ & E). destruct (fsqrt_inv _ F1) as (_ & _ & E1).
  rewrite E, E1, (proj2 (lit_correct c_up_factor eq_refl)). pose proof factor_up as U. pose proof eta_pos as EP.
  assert (S : d <= sqrt (val r)) by (rewrite <- (sqrt_square d) by exact Pd; now apply sqrt_le_1_alt).
  assert (S1 : sqrt (val r) * (1 - u) - eta <= rnd (sqrt (val r))) by apply rnd_lower, sqrt_pos.
  assert (S0 : 0 <= rnd (sqrt (val r))) by apply rnd_pos, sqrt_pos.
  assert (M : rnd (sqrt (val r)) * (1 + 10 * u) <= rnd (sqrt (val r)) * cval c_up_factor) by (apply Rmult_le_compat_l; lra).
  assert (M0 : 0 <= rnd (sqrt (val r)) * cval c_up_factor) by (apply Rmult_le_pos; [exact S0|unfold u in U; lra]).
  assert (rnd (sqrt (val r)) * cval c_up_factor * (1 - u) - eta <= rnd (rnd (sqrt (val r)) * cval c_up_factor)) by now apply
    rnd_lower.
  unfold u in *; lra.
Qed.

Section Sqrt.
Local Transparent fsqrt.
Lemma fsqrt_inf : fsqrt inf = inf.
Proof. reflexivity. Qed.
Lemma fsqrt_finite x : finite x -> 0 <= val x -> finite (fsqrt x).
Proof.
  intros F P.
  generalize (Bsqrt_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) unop_nan_pl64 mode_NE x).
  fold (b64_sqrt mode_NE x); change (b64_sqrt mode_NE x) with (fsqrt x). intros (_ & B & _). rewrite B.
  destruct x as [s|s|s q Hq|[|] m e He]; try discriminate; try reflexivity.
  exfalso. assert (F2R (Float radix2 (Zneg m) e) < 0) by (apply F2R_lt_0; simpl; lia). simpl in P. lra.
Qed.
End Sqrt.

Lemma up_lit : finite (lit c_up_factor) /\ val (lit c_up_factor) = cval c_up_factor /\ 0 < val (lit c_up_factor).
Proof.
  destruct (lit_correct c_up_factor eq_refl) as [F V]. split; [exact F|]. split; [exact V|]. rewrite V.
  pose proof factor_up. unfold u in *; lra.
Qed.

(** Infinite, or at least the distance of the double point to every point of the rectangle; never tiny. *)
Theorem radius_correct px py b R : finite px -> finite py -> outward b R ->
  radius px py b = inf \/
  (finite (radius px py b) /\ dl (val px, val py) R <= val (radius px py b) /\ 9 / 10 ^ 302 <= val (radius px py b)).
Proof.
  intros Fx Fy (O0 & O1 & O2 & O3). unfold radius. pose proof tiny_value as TV. pose proof eta_323 as H323.
  destruct (lit_correct c_tiny eq_refl) as [Ft Vt]. destruct up_lit as (Fu & _ & Pu). pose proof eta_pos as EP.
  assert (P : dl2_upper (point_box px py) b = inf \/ (finite (dl2_upper (point_box px py) b) /\
    dl (val px, val py) R * dl (val px, val py) R <= val (dl2_upper (point_box px py) b))).
  { rewrite dl_square. cbn [fst snd]. apply dl2_upper_correct; try assumption; try apply x_ordered; try apply y_ordered;
      right; (split; [assumption|simpl; lra]). }
  set (r := dl2_upper _ _) in *. set (d := dl _ R) in *. assert (Pd : 0 <= d) by apply dist_nonneg.
  destruct P as [->|[Fr P]].
  { left. rewrite fsqrt_inf, inf_mul_pos by assumption. now apply inf_add. }
  assert (R0 : 0 <= val r) by (generalize (Rle_0_sqr d); unfold Rsqr; lra).
  pose proof (fsqrt_finite r Fr R0) as Fs. pose proof (nneg_val _ (nneg_sqrt r)) as Ps.
  destruct (fmul_total_pos (fsqrt r) (lit c_up_factor) Fs Fu Ps Pu) as [[F1 _]|[E _]].
  2: { left. rewrite E. now apply inf_add. }
  pose proof (root_up r d Pd P F1) as Low.
  assert (N1 : nneg (fsqrt r * lit c_up_factor)%D) by (apply nneg_mul; [apply nneg_sqrt|apply nneg_lit; [reflexivity|simpl;
    lia]]).
  pose proof (nneg_val _ N1) as P1. assert (FT : format (cval c_tiny)) by (rewrite <- Vt; apply val_format).
  assert (Ge : 0 <= rnd (val (fsqrt r * lit c_up_factor)%D + val (lit c_tiny))) by (apply rnd_pos; lra).
  destruct (fadd_total _ _ F1 Ft) as [[F E]|[[E _]|[_ A]]]; [right|left; exact E|generalize (bpow_gt_0 radix2 1024); lra].
  split; [exact F|]. rewrite E, Vt. split.
  - assert ((val (fsqrt r * lit c_up_factor)%D + cval c_tiny) * (1 - u) <= rnd (val (fsqrt r * lit c_up_factor)%D + cval
      c_tiny)) by (apply rnd_add_lower; [apply val_format|exact FT|lra]). unfold u in *; lra.
  - apply Rle_trans with (1 := TV). rewrite <- (rnd_id (cval c_tiny)) at 1 by exact FT. apply rnd_le. lra.
Qed.

(* [FLT-STAR] src/legal/star_filter.c: p->reach = {} * (largest *)
Notation z_star_two := 2%Z.
(* [FLT-STAR] src/legal/star_filter.c: (largest + {} * sk->reps.delta); *)
Notation z_star_three := 3%Z.
Definition star_reach (largest delta : double) : double :=
  (lit (z_star_two, 0%Z) * (largest + lit (z_star_three, 0%Z) * delta))%D.

Lemma star_reach_correct largest delta : nneg largest -> nneg delta -> 9 / 10 ^ 302 <= val largest ->
  finite (star_reach largest delta) ->
  2 * (val largest + 3 * val delta) <= val (star_reach largest delta) * (1 + 3 * u) /\
  9 / 10 ^ 302 <= val (star_reach largest delta).
Proof.
  intros Nl Nd L F. unfold star_reach in *. pose proof eta_323 as H323. pose proof eta_pos as EP.
  pose proof (nneg_val _ Nl) as Pl. pose proof (nneg_val _ Nd) as Pd.
  destruct (fmul_inv _ _ F) as (_ & F1 & E). destruct (fadd_inv _ _ F1) as (F2 & F3 & E1).
  destruct (fmul_inv _ _ F3) as (_ & F4 & E2).
  rewrite (proj2 (lit_correct (2, 0)%Z eq_refl)) in E. rewrite (proj2 (lit_correct (3, 0)%Z eq_refl)) in E2.
  replace (cval (2, 0)%Z) with 2 in E by (unfold cval; simpl; ring).
  replace (cval (3, 0)%Z) with 3 in E2 by (unfold cval; simpl; ring).
  assert (A : 3 * val delta * (1 - u) - eta <= rnd (3 * val delta)) by (apply rnd_lower; lra).
  assert (A0 : 0 <= rnd (3 * val delta)) by (apply rnd_pos; lra).
  assert (B : (val largest + rnd (3 * val delta)) * (1 - u) <= rnd (val largest + rnd (3 * val delta))) by (apply
    rnd_add_lower; [apply val_format|apply rnd_format|lra]).
  rewrite E2 in E1. rewrite E1 in E. set (t := rnd (val largest + _)) in *.
  assert (C : rnd (2 * t) = 2 * t).
  { apply rnd_id. apply format_double. unfold t. apply rnd_format. }
  rewrite C in E. rewrite E. unfold u in *; split; lra.
Qed.

(** ** The disc of an edge *)

(* Where the centre comes from does not matter; the program that is run needs it. *)
(* [FLT-STAR] src/legal/star_filter.c: dyd_xy c = {(a.x + b.x) * {}, (a.y *)
(* [FLT-STAR] src/legal/star_filter.c: dyd_xy c = {(a.x + b.x) * 0.5, (a.y + b.y) * {}} *)
Definition c_star_half : const := (1, -1)%Z.

(* C src/legal/star_filter.c certify_edges
  dyd_xy v = p->sk->reps.xy[s->v];
  for (int q = 0; q < s->degree; q++) {
    if (q == s->ghost) continue;
    dyd_xy a = s->centre[q], b = s->centre[q ? q - 1 : s->degree - 1];
    dyd_xy c = {(a.x + b.x) * 0.5, (a.y + b.y) * 0.5};
    double ix = v.x - c.x, iy = v.y - c.y, jx = s->x[q] - c.x, jy = s->y[q] - c.y;
    double rho = sqrt(dyd_upper(dyd_max(ix * ix + iy * iy, jx * jx + jy * jy))) * DYD_UP_FACTOR;
    double wide = (rho + p->reach) * DYD_UP_FACTOR;
    if (!others_farther(s, q, c, dyd_upper(wide * wide))) continue;
    uint32_t j = dyd_edge_target(&p->sk->mesh, s->edge[q]);
    if (p->fat.count && (is_fat(p, j) || fat_near(p, c, wide, s->v, j))) continue;
    star_mark(p->sk, s->edge[q]);
  }
*)
Definition star_wide (vx vy jx jy cx cy reach : double) : double :=
  let rho := (fsqrt (upper (fmax (lift (vx - cx) (vy - cy)) (lift (jx - cx) (jy - cy)))) * lit c_up_factor)%D in
  ((rho + reach) * lit c_up_factor)%D.
Definition star_limit (wide : double) : double := upper (wide * wide).
(* C src/legal/star_filter.c others_farther
  int near = 0;
  for (int k = 0; k < s->degree; k++) {
    double dx = s->x[k] - c.x, dy = s->y[k] - c.y;
    near += !(dyd_lower(dx * dx + dy * dy) > limit);
  }
  double dx = s->x[q] - c.x, dy = s->y[q] - c.y;
  int self = !(dyd_lower(dx * dx + dy * dy) > limit);
  return near == self + (s->ghost >= 0);
*)
Definition surely_farther (kx ky cx cy limit : double) : bool := gt (lower (lift (kx - cx) (ky - cy))) limit.
Definition counts_as_near (c : double * double) (limit : double) (k : double * double) : nat :=
  Nat.b2n (negb (surely_farther (fst k) (snd k) (fst c) (snd c) limit)).
Definition nowhere : double * double := (nan, nan).
Definition others_farther (star : list (double * double)) (q : nat) (c : double * double) (limit : double) (ghost : bool) :
  bool := (list_sum (map (counts_as_near c limit) star) =? counts_as_near c limit (nth q star nowhere) + Nat.b2n ghost)%nat.
(** What certify_edges says of its edge q, where no rectangle is fat. *)
Definition star_edge (v a b : double * double) (star : list (double * double)) (q : nat) (ghost : bool) (reach : double) :
  bool :=
  let c := (((fst a + fst b) * lit c_star_half)%D, ((snd a + snd b) * lit c_star_half)%D) in
  let j := nth q star nowhere in
  others_farther star q c (star_limit (star_wide (fst v) (snd v) (fst j) (snd j) (fst c) (snd c) reach)) ghost.

Lemma sum_of_one (f : double * double -> nat) d l : forall q, (q < length l)%nat -> (f (nth q l d) <= list_sum (map f l))%nat.
Proof. induction l as [|x l IH]; intros [|q]; simpl; try lia. intros H. specialize (IH q ltac:(lia)). lia. Qed.
Lemma sum_of_pair (f : double * double -> nat) d l : forall q k, q <> k -> (q < length l)%nat -> (k < length l)%nat ->
  (f (nth q l d) + f (nth k l d) <= list_sum (map f l))%nat.
Proof.
  induction l as [|x l IH]; intros [|q] [|k]; simpl; try lia; intros N H K.
  - pose proof (sum_of_one f d l k ltac:(lia)). lia.
  - pose proof (sum_of_one f d l q ltac:(lia)). lia.
  - pose proof (IH q k ltac:(lia) ltac:(lia) ltac:(lia)). lia.
Qed.
Lemma sum_of_two (f : double * double -> nat) d l : forall q g, q <> g -> (q < length l)%nat -> (g < length l)%nat ->
  list_sum (map f l) = (f (nth q l d) + f (nth g l d))%nat ->
  forall k, (k < length l)%nat -> k <> q -> k <> g -> f (nth k l d) = 0%nat.
Proof.
  induction l as [|x l IH]; intros [|q] [|g] N Q G S [|k] K Kq Kg; simpl in *; try lia.
  - destruct (Nat.eq_dec k g) as [E|E]; [lia|]. pose proof (sum_of_pair f d l k g E ltac:(lia) ltac:(lia)). lia.
  - destruct (Nat.eq_dec k q) as [E|E]; [lia|]. pose proof (sum_of_pair f d l k q E ltac:(lia) ltac:(lia)). lia.
  - pose proof (sum_of_pair f d l q g ltac:(lia) ltac:(lia) ltac:(lia)). lia.
  - pose proof (sum_of_pair f d l q g ltac:(lia) ltac:(lia) ltac:(lia)). apply (IH q g); lia.
Qed.

(** Counting finds that all but q and the ghost are farther, as the ghost is not: it is NaN. *)
Definition farther_in (star : list (double * double)) (c : double * double) (limit : double) (k : nat) : bool :=
  surely_farther (fst (nth k star nowhere)) (snd (nth k star nowhere)) (fst c) (snd c) limit.
Theorem others_farther_all star q c limit ghost : (q < length star)%nat ->
  match ghost with Some g => (g < length star)%nat /\ g <> q /\ farther_in star c limit g = false | None => True end ->
  others_farther star q c limit (if ghost then true else false) = true ->
  forall k, (k < length star)%nat -> k <> q -> ghost <> Some k -> farther_in star c limit k = true.
Proof.
  intros Q G O k K Kq Kg. apply Nat.eqb_eq in O.
  assert (Z0 : counts_as_near c limit (nth k star nowhere) = 0%nat).
  { destruct ghost as [g|]; cbn [Nat.b2n] in O.
    - destruct G as (Gl & Gq & Gf). apply (sum_of_two (counts_as_near c limit) nowhere star q g); try assumption; try congruence.
      rewrite O. f_equal. unfold counts_as_near. unfold farther_in in Gf. now rewrite Gf.
    - rewrite Nat.add_0_r in O. pose proof (sum_of_pair (counts_as_near c limit) nowhere star q k ltac:(congruence) Q K). lia. }
  unfold counts_as_near in Z0. unfold farther_in. destruct (surely_farther _ _ _ _ _); [reflexivity|discriminate Z0].
Qed.

Lemma upper_nneg x : nneg x -> nneg (upper x).
Proof. intros N. unfold upper. apply nneg_add; [apply nneg_mul; [exact N|]|]; (apply nneg_lit; [reflexivity|simpl; lia]). Qed.
Lemma lift_nneg x y : nneg (lift x y).
Proof. unfold lift. apply nneg_add; apply nneg_sqr. Qed.
Lemma lift_ends ax ay cx cy : finite (lift (ax - cx) (ay - cy)) -> finite cx /\ finite cy.
Proof.
  intros F. unfold lift in F. destruct (fadd_inv _ _ F) as (F1 & F2 & _). destruct (fmul_inv _ _ F1) as (F3 & _).
  destruct (fmul_inv _ _ F2) as (F4 & _). destruct (fsub_inv _ _ F3) as (_ & G & _). destruct (fsub_inv _ _ F4) as (_ & H &
    _). now split.
Qed.

(** The larger of two sums of squares is finite only if both are. *)
Lemma larger_lift vx vy jx jy cx cy : finite vx -> finite vy ->
  let a := lift (vx - cx) (vy - cy) in let b := lift (jx - cx) (jy - cy) in
  finite (fmax a b) -> finite cx /\ finite cy /\ finite a /\ finite b.
Proof.
  intros Fx Fy a b F. pose proof (lift_nneg (vx - cx) (vy - cy)) as Na. pose proof (lift_nneg (jx - cx) (jy - cy)) as Nb.
  fold a in Na. fold b in Nb. unfold fmax in F. destruct (gt a b) eqn:G.
  - destruct (lift_ends _ _ _ _ F) as [Fcx Fcy]. split; [exact Fcx|]. split; [exact Fcy|]. split; [exact F|].
    now apply gt_nneg_finite with a.
  - destruct (lift_ends _ _ _ _ F) as [Fcx Fcy]. split; [exact Fcx|]. split; [exact Fcy|]. split; [|exact F].
    destruct (lift_bounds vx vy cx cy Fx Fy Fcx Fcy) as [[E|[H _]] _]; [|exact H]. fold a in E. rewrite E in G.
    rewrite (gt_of_inf _ F) in G. discriminate.
Qed.

Lemma wide_bound vx vy jx jy cx cy reach : finite vx -> finite vy -> finite jx -> finite jy ->
  nneg reach -> 9 / 10 ^ 302 <= val reach ->
  let wide := star_wide vx vy jx jy cx cy reach in let c := (val cx, val cy) in
  finite (star_limit wide) ->
  finite cx /\ finite cy /\ finite wide /\ val wide * val wide <= val (star_limit wide) /\
  dist c (val vx, val vy) + val reach * (1 + 3 * u) <= val wide /\
  dist c (val jx, val jy) + val reach * (1 + 3 * u) <= val wide.
Proof.
  intros Fvx Fvy Fjx Fjy Nr Lr wide c F. pose proof eta_323 as H323. pose proof eta_pos as EP.
  assert (Fw2 : finite (wide * wide)%D).
  { unfold star_limit, upper in F. destruct (fadd_inv _ _ F) as (F1 & _). now destruct (fmul_inv _ _ F1) as (F2 & _). }
  destruct (fmul_inv _ _ Fw2) as (Fw & _ & Ew2).
  set (a := lift (vx - cx) (vy - cy)). set (b := lift (jx - cx) (jy - cy)).
  unfold wide, star_wide in Fw. cbv zeta in Fw. fold a b in Fw.
  destruct (fmul_inv _ _ Fw) as (Fs & _ & Ew). destruct (fadd_inv _ _ Fs) as (Frho & Fr & Es).
  destruct (fmul_inv _ _ Frho) as (Fq & _ & _). destruct (fsqrt_inv _ Fq) as (Fup & _ & _).
  pose proof Fup as Fm. unfold upper in Fm. destruct (fadd_inv _ _ Fm) as (Fm1 & _). destruct (fmul_inv _ _ Fm1) as (Fm2 & _).
  destruct (larger_lift vx vy jx jy cx cy Fvx Fvy Fm2) as (Fcx & Fcy & Fa & Fb). fold a in Fa. fold b in Fb.
  destruct (gt_max a b Fa Fb) as (_ & Ma & Mb). fold (fmax a b) in Ma, Mb.
  destruct (lift_bounds vx vy cx cy Fvx Fvy Fcx Fcy) as [Ua _]. destruct (lift_bounds jx jy cx cy Fjx Fjy Fcx Fcy) as [Ub _].
  fold a c in Ua. fold b c in Ub.
  set (m := fmax a b) in *.
  assert (root : forall z d, upb z (d * d * (1 - 62 / 10 * u) - 4 * eta) -> finite z -> val z <= val m -> d * d <= val (upper
    m)).
  { intros z d U Fz L. destruct (upper_correct m (d * d)) as [E|[_ H]]; [apply Rle_0_sqr| | |exact H].
    - destruct U as [->|[_ [P V]]]; [discriminate|]. right. split; [exact Fm2|]. split; lra.
    - rewrite E in Fup. discriminate. }
  rewrite <- dist_sq in Ua, Ub.
  pose proof (root a _ Ua Fa Ma) as Rv. pose proof (root b _ Ub Fb Mb) as Rj.
  pose proof (root_up (upper m) _ (dist_nonneg _ _) Rv Frho) as Lv.
  pose proof (root_up (upper m) _ (dist_nonneg _ _) Rj Frho) as Lj.
  assert (Nrho : nneg (fsqrt (upper m) * lit c_up_factor)%D) by (apply nneg_mul; [apply nneg_sqrt|apply nneg_lit;
    [reflexivity|simpl; lia]]).
  pose proof (nneg_val _ Nrho) as Prho. pose proof (nneg_val _ Nr) as Pr. set (rho := (fsqrt (upper m) * lit c_up_factor)%D)
    in *.
  assert (S : (val rho + val reach) * (1 - u) <= val (rho + reach)%D) by (rewrite Es; apply rnd_add_lower; try apply
    val_format; lra).
  assert (S0 : 0 <= val (rho + reach)%D) by (rewrite Es; apply rnd_pos; lra).
  pose proof factor_up as Up. destruct up_lit as (_ & Vu & _). rewrite Vu in Ew.
  assert (M : val (rho + reach)%D * (1 + 10 * u) <= val (rho + reach)%D * cval c_up_factor) by (apply Rmult_le_compat_l; lra).
  assert (M0 : 0 <= val (rho + reach)%D * cval c_up_factor) by (apply Rmult_le_pos; [exact S0|unfold u in Up; lra]).
  assert (Wd : val (rho + reach)%D * cval c_up_factor * (1 - u) - eta <= val wide).
  { unfold wide, star_wide. cbv zeta. fold a b m rho. rewrite Ew. now apply rnd_lower. }
  assert (Pv : 0 <= dist c (val vx, val vy)) by apply dist_nonneg.
  assert (Pj : 0 <= dist c (val jx, val jy)) by apply dist_nonneg.
  fold wide in Fw. split; [exact Fcx|]. split; [exact Fcy|]. split; [exact Fw|]. split; [|split; unfold u in *; lra].
  destruct (upper_correct (wide * wide)%D (val wide * val wide)) as [E|[_ H]]; [apply Rle_0_sqr| | |exact H].
  - right. split; [exact Fw2|]. rewrite Ew2. assert (0 <= val wide * val wide) by apply Rle_0_sqr.
    split; [now apply rnd_pos|]. pose proof (rnd_lower _ H). unfold u in *; lra.
  - unfold star_limit in F. rewrite E in F. discriminate.
Qed.

(** A neighbour that counts as farther is outside the disc, by the reach. *)
Theorem surely_farther_correct vx vy jx jy kx ky cx cy reach : finite vx -> finite vy -> finite jx -> finite jy ->
  finite kx -> finite ky -> nneg reach -> 9 / 10 ^ 302 <= val reach ->
  let c := (val cx, val cy) in
  surely_farther kx ky cx cy (star_limit (star_wide vx vy jx jy cx cy reach)) = true ->
  dist c (val vx, val vy) + val reach * (1 + 3 * u) < dist c (val kx, val ky) /\
  dist c (val jx, val jy) + val reach * (1 + 3 * u) < dist c (val kx, val ky).
Proof.
  intros Fvx Fvy Fjx Fjy Fkx Fky Nr Lr c G. unfold surely_farther in G.
  pose proof (upper_nneg _ (nneg_sqr (star_wide vx vy jx jy cx cy reach))) as N.
  pose proof (gt_nneg_finite _ _ N G) as F.
  destruct (wide_bound vx vy jx jy cx cy reach Fvx Fvy Fjx Fjy Nr Lr F) as (Fcx & Fcy & _ & W2 & Hv & Hj).
  fold c in Hv, Hj. set (wide := star_wide vx vy jx jy cx cy reach) in *.
  destruct (lift_bounds kx ky cx cy Fkx Fky Fcx Fcy) as [_ Low]. fold c in Low.
  destruct (lower_correct _ _ (dist2_nonneg _ _) Low) as [NI Val].
  assert (K : val wide < dist c (val kx, val ky)).
  { set (x := lower _) in *. change (upper (wide * wide)%D) with (star_limit wide) in *.
    assert (Fx : finite x).
    { destruct (cases x) as [X|[X|[X|X]]]; [exact X|exfalso..].
      - destruct x; try discriminate; destruct (star_limit wide); discriminate.
      - contradiction.
      - rewrite X in G. rewrite (gt_ninf _ F) in G. discriminate. }
    apply gt_finite in G; [|exact Fx|exact F]. specialize (Val Fx). rewrite <- dist_sq in Val.
    destruct (Rlt_or_le (val wide) (dist c (val kx, val ky))) as [L|L]; [exact L|exfalso].
    assert (dist c (val kx, val ky) * dist c (val kx, val ky) <= val wide * val wide) by (apply Rmult_le_compat; try assumption;
      apply dist_nonneg). lra. }
  split; lra.
Qed.

(** A rectangle that the search round c with the limit as squared radius does not meet is outside as well. *)
Theorem fat_farther_correct vx vy jx jy cx cy reach b R : finite vx -> finite vy -> finite jx -> finite jy ->
  nneg reach -> 9 / 10 ^ 302 <= val reach -> outward b R ->
  let c := (val cx, val cy) in
  gt (ds2_lower (point_box cx cy) b) (star_limit (star_wide vx vy jx jy cx cy reach)) = true ->
  dist c (val vx, val vy) + val reach * (1 + 3 * u) < ds c R /\ dist c (val jx, val jy) + val reach * (1 + 3 * u) < ds c R.
Proof.
  intros Fvx Fvy Fjx Fjy Nr Lr (O0 & O1 & O2 & O3) c G.
  pose proof (upper_nneg _ (nneg_sqr (star_wide vx vy jx jy cx cy reach))) as N.
  pose proof (gt_nneg_finite _ _ N G) as F.
  destruct (wide_bound vx vy jx jy cx cy reach Fvx Fvy Fjx Fjy Nr Lr F) as (Fcx & Fcy & _ & W2 & Hv & Hj).
  fold c in Hv, Hj. set (wide := star_wide vx vy jx jy cx cy reach) in *.
  assert (L : ds2_lower (point_box cx cy) b <> inf /\ (finite (ds2_lower (point_box cx cy) b) ->
    val (ds2_lower (point_box cx cy) b) <= ds c R * ds c R)).
  { rewrite ds_square. unfold c. cbn [fst snd].
    apply ds2_lower_correct; try assumption; right; (split; [assumption|simpl; lra]). }
  destruct L as [NI Val]. set (x := ds2_lower _ _) in *. change (upper (wide * wide)%D) with (star_limit wide) in *.
  assert (Fx : finite x).
  { destruct (cases x) as [X|[X|[X|X]]]; [exact X|exfalso..].
    - destruct x; try discriminate; destruct (star_limit wide); discriminate.
    - contradiction.
    - rewrite X in G. rewrite (gt_ninf _ F) in G. discriminate. }
  apply gt_finite in G; [|exact Fx|exact F]. specialize (Val Fx).
  assert (K : val wide < ds c R).
  { destruct (Rlt_or_le (val wide) (ds c R)) as [K|K]; [exact K|exfalso].
    assert (ds c R * ds c R <= val wide * val wide) by (apply Rmult_le_compat; try assumption; apply dist_nonneg). lra. }
  split; lra.
Qed.
