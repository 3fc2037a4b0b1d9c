(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-DIR] for rectangles: who reaches as far as the farthest, or as the nearest point of v; the direction in doubles;
    the boxes of the nodes. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Relative Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersOrient FiltersDistance FiltersInterval
  FiltersNearCode FiltersDirection.
From Dyadel Require Import Plane Distance.
Open Scope R_scope.

(** ** Outward boxes *)

(** b holds the rectangle R. *)
Definition outward (b : bbox) (R : rect) : Prop :=
  lower_end (e0 b) (xlo R) /\ upper_end (e1 b) (xhi R) /\ lower_end (e2 b) (ylo R) /\ upper_end (e3 b) (yhi R).
(** A finite end lies outside by at most a unit in the last place. *)
Definition tight_end (f : double) (x : R) : Prop := finite f -> Rabs (val f - x) <= 2 * u * Rabs (val f) + 2 * eta.
Definition tight (b : bbox) (R : rect) : Prop :=
  tight_end (e0 b) (xlo R) /\ tight_end (e1 b) (xhi R) /\ tight_end (e2 b) (ylo R) /\ tight_end (e3 b) (yhi R).

Lemma lower_end_less f x y : lower_end f x -> x <= y -> lower_end f y.
Proof. intros [->|[F V]] H; [now left|right; split; [exact F|lra]]. Qed.
Lemma upper_end_more f x y : upper_end f x -> y <= x -> upper_end f y.
Proof. intros [->|[F V]] H; [now left|right; split; [exact F|lra]]. Qed.
Lemma outward_inside b R z : outward b R -> inside z R ->
  lower_end (e0 b) (fst z) /\ upper_end (e1 b) (fst z) /\ lower_end (e2 b) (snd z) /\ upper_end (e3 b) (snd z).
Proof.
  intros (A & B & C & D) [X Y]. repeat split;
    [now apply lower_end_less with (xlo R)|now apply upper_end_more with (xhi R)|
     now apply lower_end_less with (ylo R)|now apply upper_end_more with (yhi R)].
Qed.

(* C src/skeleton/rects_filter.h dyd_min
  return a < b ? a : b;
*)
Definition fmin (a b : double) : double := if lt a b then a else b.
(* C src/skeleton/rects_filter.h dyd_box_widen
  h->e[0] = dyd_min(h->e[0], b->e[0]);
  h->e[1] = dyd_max(h->e[1], b->e[1]);
  h->e[2] = dyd_min(h->e[2], b->e[2]);
  h->e[3] = dyd_max(h->e[3], b->e[3]);
*)
Definition hull (h b : bbox) : bbox :=
  {| e0 := fmin (e0 h) (e0 b); e1 := fmax (e1 h) (e1 b); e2 := fmin (e2 h) (e2 b); e3 := fmax (e3 h) (e3 b) |}.

Lemma fmin_lower a b x y : lower_end a x -> lower_end b y -> lower_end (fmin a b) x /\ lower_end (fmin a b) y.
Proof.
  unfold fmin. intros [->|[Fa A]] [->|[Fb B]].
  - split; now left.
  - replace (lt ninf b) with true by (destruct b; try discriminate; reflexivity). split; now left.
  - replace (lt a ninf) with false by (destruct a; try discriminate; reflexivity). split; now left.
  - generalize (lt_finite a b Fa Fb). destruct (lt a b); intros [I J].
    + specialize (I eq_refl). split; right; (split; [exact Fa|lra]).
    + assert (val b <= val a) by (destruct (Rle_or_lt (val b) (val a)) as [L|L]; [exact L|discriminate (J L)]).
      split; right; (split; [exact Fb|lra]).
Qed.
Lemma fmax_upper a b x y : upper_end a x -> upper_end b y -> upper_end (fmax a b) x /\ upper_end (fmax a b) y.
Proof.
  unfold fmax. intros [->|[Fa A]] [->|[Fb B]].
  - split; now left.
  - rewrite (gt_of_inf _ Fb). split; now left.
  - replace (gt a inf) with false by (destruct a; try discriminate; reflexivity). split; now left.
  - generalize (gt_finite a b Fa Fb). destruct (gt a b); intros [I J].
    + specialize (I eq_refl). split; right; (split; [exact Fa|lra]).
    + assert (val a <= val b) by (destruct (Rle_or_lt (val a) (val b)) as [L|L]; [exact L|discriminate (J L)]).
      split; right; (split; [exact Fb|lra]).
Qed.
(** The box of a node holds what the boxes of its children hold. *)
Theorem hull_outward h b R S : outward h R -> outward b S -> outward (hull h b) R /\ outward (hull h b) S.
Proof.
  intros (A0 & A1 & A2 & A3) (B0 & B1 & B2 & B3).
  destruct (fmin_lower _ _ _ _ A0 B0). destruct (fmax_upper _ _ _ _ A1 B1). destruct (fmin_lower _ _ _ _ A2 B2).
  destruct (fmax_upper _ _ _ _ A3 B3). split; repeat split; assumption.
Qed.

(** ** The direction *)

(** What mpz_get_d_2exp and ldexp give of an integer: 53 bits, the rest cut off; e bits, top at least as many. *)
Definition cut_component (W top : Z) : R :=
  if (mag radix2 (IZR W) - top <? -900)%Z then 0 else round radix2 (FLX_exp 53) Ztrunc (IZR W) * bpow radix2 (- top).

Lemma cut_smaller x : Rabs (round radix2 (FLX_exp 53) Ztrunc x) <= Rabs x.
Proof.
  assert (P : forall y, 0 <= y -> Rabs (round radix2 (FLX_exp 53) Ztrunc y) <= Rabs y).
  { intros y H. rewrite round_ZR_DN by exact H.
    destruct (round_DN_pt radix2 (FLX_exp 53) y) as (_ & B & C).
    assert (0 <= round radix2 (FLX_exp 53) Zfloor y) by (apply C; [apply generic_format_0|exact H]).
    rewrite !Rabs_pos_eq; assumption. }
  destruct (Rle_or_lt 0 x) as [H|H]; [now apply P|].
  pose proof (P (- x) ltac:(lra)) as Q. rewrite round_ZR_opp, !Rabs_Ropp in Q. exact Q.
Qed.

(* C src/skeleton/rects_filter.c dyd_direction_d
  long e[2];
  u[0] = mpz_get_d_2exp(&e[0], x);
  u[1] = mpz_get_d_2exp(&e[1], y);
  long top = u[0] == 0 ? e[1] : u[1] == 0 || e[0] > e[1] ? e[0] : e[1];
  for (int a = 0; a < 2; a++) u[a] = e[a] - top < -900 ? 0 : ldexp(u[a], (int)(e[a] - top));
*)
(** As a program: the first 53 of its bits, and how many are dropped. *)
Definition first_bits (W : Z) : Z * Z :=
  let more := (Zdigits2 W - 53)%Z in if (more <=? 0)%Z then (W, 0%Z) else (Z.quot W (2 ^ more), more).
Definition component (W top : Z) : double :=
  if (Zdigits2 W - top <? -900)%Z then lit c_zero else lit (fst (first_bits W), (snd (first_bits W) - top)%Z).
Definition direction_d (x y : Z) : double * double :=
  let top := if (x =? 0)%Z then Zdigits2 y else if (y =? 0)%Z || (Zdigits2 y <? Zdigits2 x)%Z then Zdigits2 x else
    Zdigits2 y in
  (component x top, component y top).

Lemma digits_mag W : W <> 0%Z -> mag radix2 (IZR W) = Zdigits2 W :> Z.
Proof. intros N. rewrite Zdigits2_Zdigits. symmetry. now apply Zdigits_mag. Qed.

Lemma first_bits_round W : W <> 0%Z ->
  round radix2 (FLX_exp 53) Ztrunc (IZR W) = IZR (fst (first_bits W)) * bpow radix2 (snd (first_bits W)) /\
  (Z.abs (fst (first_bits W)) < 2 ^ 53)%Z /\ snd (first_bits W) = Z.max 0 (Zdigits2 W - 53).
Proof.
  intros N. pose proof (digits_mag W N) as M. pose proof (Zdigits_correct radix2 W) as [_ D].
  rewrite <- Zdigits2_Zdigits in D. change (radix_val radix2) with 2%Z in D. unfold first_bits. cbv zeta.
  destruct (Z.leb_spec (Zdigits2 W - 53) 0) as [L|L]; cbn [fst snd].
  - assert (B : (Z.abs W < 2 ^ 53)%Z).
    { apply Z.lt_le_trans with (1 := D). apply Z.pow_le_mono_r; lia. }
    split; [|split; [exact B|lia]]. cbn [bpow]. rewrite Rmult_1_r. apply round_generic; [typeclasses eauto|].
    apply generic_format_FLX. exists (Float radix2 W 0); [unfold F2R; cbn [Fnum Fexp bpow]; ring|exact B].
  - set (k := (Zdigits2 W - 53)%Z) in *. assert (P : (0 < 2 ^ k)%Z) by (apply Z.pow_pos_nonneg; lia).
    split; [|split; [|lia]].
    + unfold round, scaled_mantissa, cexp, F2R. cbn [Fnum Fexp]. rewrite M. unfold FLX_exp. fold k. f_equal. f_equal.
      rewrite bpow_opp. rewrite <- (IZR_Zpower radix2) by lia. change (radix_val radix2) with 2%Z. apply Ztrunc_div. lia.
    + rewrite <- Z.quot_abs by lia. rewrite (Z.abs_eq (2 ^ k)) by lia. rewrite Z.quot_div_nonneg by lia.
      apply Z.div_lt_upper_bound; [exact P|]. rewrite <- Z.pow_add_r by lia. replace (k + 53)%Z with (Zdigits2 W) by lia.
      exact D.
Qed.

Section Zero.
Local Transparent lit.
Lemma zero_component e : val (lit (0%Z, e)) = 0.
Proof. reflexivity. Qed.
End Zero.

(** The theorem is about the program that is run. *)
Theorem component_cut W top : W = 0%Z \/ (Zdigits2 W <= top)%Z -> val (component W top) = cut_component W top.
Proof.
  intros T. unfold component, cut_component. destruct (Z.eq_dec W 0) as [->|N].
  { assert (Z0 : val (lit c_zero) = 0) by apply zero_lit. rewrite round_0, Rmult_0_l by typeclasses eauto.
    destruct (_ <? -900)%Z; destruct (_ <? -900)%Z; cbn [first_bits fst snd]; try exact Z0; apply zero_component. }
  destruct T as [T|T]; [contradiction|]. rewrite (digits_mag W N). destruct (Z.ltb_spec (Zdigits2 W - top) (-900)) as [L|L].
  { apply zero_lit. }
  destruct (first_bits_round W N) as (R & B & P).
  assert (D : is_double (fst (first_bits W), (snd (first_bits W) - top)%Z) = true).
  { unfold is_double. cbn [fst snd]. rewrite !andb_true_iff, Z.ltb_lt, !Z.leb_le.
    pose proof (Zdigits_gt_0 radix2 W N) as G. rewrite <- Zdigits2_Zdigits in G. lia. }
  destruct (lit_correct _ D) as [_ V]. rewrite V, R. unfold cval. cbn [fst snd]. unfold Z.sub. rewrite bpow_plus. ring.
Qed.

Theorem direction_near w W top : W = 0%Z \/ (mag radix2 (IZR W) <= top)%Z -> val w = cut_component W top ->
  near_direction w (IZR W * bpow radix2 (- top)) /\ Rabs (val w) <= 1.
Proof.
  intros T E. unfold near_direction. rewrite E. clear E w. unfold cut_component.
  assert (Pz : 0 < cval c_height_cut).
  { unfold c_height_cut, cval; cbn [fst snd]. generalize (bpow_gt_0 radix2 (-898)); lra. }
  assert (Qz : bpow radix2 (-900) = cval c_height_cut / 4).
  { unfold c_height_cut, cval; cbn [fst snd]. change (-898)%Z with (2 + -900)%Z. rewrite bpow_plus.
    change (bpow radix2 2) with 4. field. }
  assert (B : 0 < bpow radix2 (- top)) by apply bpow_gt_0.
  destruct (Z.eq_dec W 0) as [->|NW].
  { rewrite round_0, Rmult_0_l by typeclasses eauto. destruct (_ <? _)%Z; rewrite Rminus_0_r, Rabs_R0; lra. }
  destruct T as [T|T]; [contradiction|].
  assert (N0 : IZR W <> 0) by (apply IZR_neq; exact NW).
  assert (Up : Rabs (IZR W) <= bpow radix2 (mag radix2 (IZR W))).
  { left. apply bpow_mag_gt. }
  assert (Scale : Rabs (IZR W * bpow radix2 (- top)) <= bpow radix2 (mag radix2 (IZR W) - top)).
  { rewrite Rabs_mult, (Rabs_pos_eq (bpow _ _)) by lra. unfold Z.sub. rewrite bpow_plus. apply Rmult_le_compat_r; lra. }
  destruct (_ <? _)%Z eqn:C.
  - apply Z.ltb_lt in C. rewrite Rminus_0_r, Rabs_R0. split; [|lra].
    apply Rle_trans with (1 := Scale). apply Rle_trans with (bpow radix2 (-900)); [apply bpow_le; lia|].
    rewrite Qz. generalize (Rabs_pos (IZR W * bpow radix2 (- top))). unfold u; lra.
  - set (r := round radix2 (FLX_exp 53) Ztrunc (IZR W)).
    assert (Er : Rabs (r - IZR W) <= 2 * u * Rabs (IZR W)).
    { left. unfold r. replace (2 * u) with (bpow radix2 (- (53) + 1)).
      - now apply (relative_error_FLX radix2 53 eq_refl Ztrunc).
      - unfold u. change (bpow radix2 (- (53) + 1)) with (/ 4503599627370496). lra. }
    split.
    + replace (IZR W * bpow radix2 (- top) - r * bpow radix2 (- top)) with (- ((r - IZR W) * bpow radix2 (- top))) by ring.
      rewrite Rabs_Ropp, !Rabs_mult, (Rabs_pos_eq (bpow _ _)) by lra.
      assert (Rabs (r - IZR W) * bpow radix2 (- top) <= 2 * u * Rabs (IZR W) * bpow radix2 (- top)) by (apply
        Rmult_le_compat_r; lra). lra.
    + apply Rle_trans with (Rabs (IZR W * bpow radix2 (- top))).
      * rewrite !Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|]. apply cut_smaller.
      * apply Rle_trans with (1 := Scale). apply (bpow_le radix2 _ 0). lia.
Qed.

(** ** Rectangles *)

Lemma outer_end ux b0 b1 x0 x1 : finite ux -> lower_end b0 x0 -> upper_end b1 x1 -> tight_end b0 x0 -> tight_end b1 x1 ->
  let q := farther_end ux b0 b1 in let x := if gt ux (lit c_zero) then x1 else x0 in
  finite q -> val ux * val q <= val ux * x + Rabs (val ux) * (2 * u * Rabs (val q) + 2 * eta).
Proof.
  intros Fu _ _ T0 T1 q x F. unfold q, x, farther_end in *. destruct zero_lit as [Fz Vz].
  generalize (gt_finite ux (lit c_zero) Fu Fz). rewrite Vz. destruct (gt ux (lit c_zero)); intros [I J].
  - specialize (I eq_refl). specialize (T1 F). apply Rabs_le_inv in T1. rewrite (Rabs_pos_eq (val ux)) by lra.
    assert (val ux * val b1 <= val ux * (x1 + (2 * u * Rabs (val b1) + 2 * eta))) by (apply Rmult_le_compat_l; lra). lra.
  - assert (N : val ux <= 0) by (destruct (Rle_or_lt (val ux) 0) as [K|K]; [exact K|discriminate (J K)]).
    specialize (T0 F). apply Rabs_le_inv in T0. rewrite (Rabs_left1 (val ux)) by lra.
    assert (- val ux * (x0 - (2 * u * Rabs (val b0) + 2 * eta)) <= - val ux * val b0) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** Rk reaches as far as the farthest point of Rv: the node or box b above it is visited. *)
Theorem beyond_visits_farthest all b p Rk Rv ux uy UX UY zk : in_box p all -> outward all Rk -> outward all Rv ->
  outward b Rk -> outward p Rv -> tight p Rv -> finite ux -> finite uy -> near_direction ux UX -> near_direction uy UY ->
  Rabs (val ux) <= 1 -> Rabs (val uy) <= 1 -> inside zk Rk ->
  (forall z, inside z Rv -> UX * fst z + UY * snd z <= UX * fst zk + UY * snd zk) ->
  lt (reach b ux uy) (height_lower all ux uy p) = false.
Proof.
  intros I Ak Av B (P0 & P1 & P2 & P3) (T0 & T1 & T2 & T3) Fu Fv Nx Ny U1 U2 K H.
  set (zv := (if gt ux (lit c_zero) then xhi Rv else xlo Rv, if gt uy (lit c_zero) then yhi Rv else ylo Rv)).
  assert (V : inside zv Rv).
  { pose proof (x_ordered Rv). pose proof (y_ordered Rv). unfold inside, zv. cbn [fst snd].
    destruct (gt ux (lit c_zero)); destruct (gt uy (lit c_zero)); repeat split; lra. }
  destruct (outward_inside all Rk zk Ak K) as (K0 & K1 & K2 & K3).
  destruct (outward_inside all Rv zv Av V) as (V0 & V1 & V2 & V3).
  destruct (outward_inside b Rk zk B K) as (B0 & B1 & B2 & B3).
  apply (beyond_visits all b p ux uy UX UY (fst zk) (snd zk) (fst zv) (snd zv)); try assumption.
  - intros F. now apply outer_end.
  - intros F. now apply outer_end.
  - now apply H.
Qed.

(** The corner of a box that is nearest along u, as a box: own_height of src/skeleton/hull.c. *)
Definition nearer_end (ux lower upper : double) : double := if gt ux (lit c_zero) then lower else upper.
Definition nearer_corner (p : bbox) (ux uy : double) : bbox :=
  let x := nearer_end ux (e0 p) (e1 p) in let y := nearer_end uy (e2 p) (e3 p) in
  {| e0 := x; e1 := x; e2 := y; e3 := y |}.

Lemma le_refl_number f : is_nan 53 1024 f = false -> le f f = true.
Proof.
  intros N. destruct (cases f) as [F|[F|[F|F]]]; [apply le_finite; try assumption; lra|congruence|rewrite F; reflexivity|
    rewrite F; reflexivity].
Qed.
Lemma le_trans_double a b c : le a b = true -> le b c = true -> le a c = true.
Proof.
  intros H K. destruct (cases a) as [F|[F|[F|F]]].
  - destruct (le_from a b F H) as [[G A]| ->].
    + destruct (le_from b c G K) as [[E B]| ->].
      * apply le_finite; try assumption. lra.
      * destruct a as [|[|]| |]; try discriminate; reflexivity.
    + destruct c as [|[|]| |]; try discriminate. destruct a as [|[|]| |]; try discriminate; reflexivity.
  - destruct a; discriminate.
  - subst a. destruct b as [|[|]| |]; try discriminate. exact K.
  - subst a. destruct c as [|[|]| |]; try reflexivity. destruct b as [|[|]| |]; discriminate.
Qed.
Lemma nearer_corner_in_box p all ux uy : in_box p all -> in_box (nearer_corner p ux uy) all.
Proof.
  assert (num : forall a b, le a b = true -> is_nan 53 1024 a = false /\ is_nan 53 1024 b = false).
  { intros a b H. destruct a as [|[|]| |]; destruct b as [|[|]| |]; try discriminate; split; reflexivity. }
  assert (one : forall w l a b h, le l a = true -> le a b = true -> le b h = true ->
    le l (nearer_end w a b) = true /\ le (nearer_end w a b) (nearer_end w a b) = true /\ le (nearer_end w a b) h = true).
  { intros w l a b h A B C. destruct (num a b B). unfold nearer_end. destruct (gt w (lit c_zero)).
    - split; [exact A|]. split; [now apply le_refl_number|]. now apply le_trans_double with b.
    - split; [now apply le_trans_double with a|]. split; [now apply le_refl_number|exact C]. }
  intros [(X1 & X2 & X3) (Y1 & Y2 & Y3)]. split; cbn; now apply one.
Qed.

Lemma inner_end ux b0 b1 x0 x1 x : finite ux -> lower_end b0 x0 -> upper_end b1 x1 -> x0 <= x <= x1 ->
  let q := nearer_end ux b0 b1 in
  finite q -> val ux * val q <= val ux * x + Rabs (val ux) * (2 * u * Rabs (val q) + 2 * eta).
Proof.
  intros Fu L U X q F. unfold q, nearer_end in *. destruct zero_lit as [Fz Vz].
  assert (P : 0 <= Rabs (val ux) * (2 * u * Rabs (val (if gt ux (lit c_zero) then b0 else b1)) + 2 * eta)).
  { apply Rmult_le_pos; [apply Rabs_pos|]. pose proof (Rabs_pos (val (if gt ux (lit c_zero) then b0 else b1))).
    pose proof eta_pos. unfold u; lra. }
  revert P F. generalize (gt_finite ux (lit c_zero) Fu Fz). rewrite Vz. destruct (gt ux (lit c_zero)); intros [I J] P F.
  - specialize (I eq_refl). destruct L as [->|[_ L]]; [discriminate|].
    assert (val ux * val b0 <= val ux * x) by (apply Rmult_le_compat_l; lra). lra.
  - assert (N : val ux <= 0) by (destruct (Rle_or_lt (val ux) 0) as [K|K]; [exact K|discriminate (J K)]).
    destruct U as [->|[_ U]]; [discriminate|].
    assert (- val ux * x <= - val ux * val b1) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** Rk reaches as far as some point of Rv; the corner is given. *)
Theorem beyond_visits_nearest all b p Rk Rv ux uy UX UY zk zv : in_box p all -> outward all Rk -> outward all Rv ->
  outward b Rk -> outward p Rv -> finite ux -> finite uy -> near_direction ux UX -> near_direction uy UY ->
  Rabs (val ux) <= 1 -> Rabs (val uy) <= 1 -> inside zk Rk -> inside zv Rv ->
  UX * fst zv + UY * snd zv <= UX * fst zk + UY * snd zk ->
  lt (reach b ux uy) (height_lower all ux uy (nearer_corner p ux uy)) = false.
Proof.
  intros I Ak Av B (P0 & P1 & P2 & P3) Fu Fv Nx Ny U1 U2 K V H.
  destruct (outward_inside all Rk zk Ak K) as (K0 & K1 & K2 & K3).
  destruct (outward_inside all Rv zv Av V) as (V0 & V1 & V2 & V3).
  destruct (outward_inside b Rk zk B K) as (B0 & B1 & B2 & B3).
  assert (same : forall w f, farther_end w f f = f) by (intros; unfold farther_end; now destruct (gt w (lit c_zero))).
  apply (beyond_visits all b _ ux uy UX UY (fst zk) (snd zk) (fst zv) (snd zv)); try assumption;
    [now apply nearer_corner_in_box| |]; cbn; rewrite same; intros F; destruct V as [Vx Vy].
  - now apply (inner_end ux _ _ _ _ _ Fu P0 P1).
  - now apply (inner_end uy _ _ _ _ _ Fv P2 P3).
Qed.
