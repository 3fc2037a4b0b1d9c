(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Double-double arithmetic of src/metric/measure_filter.c on numbers that are not negative: sums and products with
    relative errors of a few u^2, and inflate, which makes an upper bound. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Flocq Require Pff.Pff2Flocq.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance.
Open Scope R_scope.

(** ** The C code *)

Definition ffma : double -> double -> double -> double := b64_fma mode_NE.
(** h and l. *)
Definition dd : Type := (double * double)%type.

(* C src/metric/measure_filter.c two_sum
  double s = a + b, t = s - a;
  return (dd){s, (a - (s - t)) + (b - t)};
*)
Definition two_sum (a b : double) : dd :=
  let s := (a + b)%D in let t := (s - a)%D in (s, ((a - (s - t)) + (b - t))%D).
(* C src/metric/measure_filter.c fast_two_sum
  double s = a + b;
  return (dd){s, b - (s - a)};
*)
Definition fast_two_sum (a b : double) : dd := let s := (a + b)%D in (s, (b - (s - a))%D).
(* C src/metric/measure_filter.c dd_sub_d
  return two_sum(a, -b);
*)
Definition dd_sub_d (a b : double) : dd := two_sum a (- b)%D.
(* C src/metric/measure_filter.c dd_add
  dd s = two_sum(x.h, y.h);
  return fast_two_sum(s.h, s.l + (x.l + y.l));
*)
Definition dd_add (x y : dd) : dd :=
  let s := two_sum (fst x) (fst y) in fast_two_sum (fst s) (snd s + (snd x + snd y))%D.
(* C src/metric/measure_filter.c dd_mul
  double p = x.h * y.h, e = fma(x.h, y.h, -p);
  return fast_two_sum(p, e + (x.h * y.l + x.l * y.h));
*)
Definition dd_mul (x y : dd) : dd :=
  let p := (fst x * fst y)%D in let e := ffma (fst x) (fst y) (- p)%D in
  fast_two_sum p (e + (fst x * snd y + snd x * fst y))%D.
(* [AREA-T] src/metric/measure_filter.c: out[1] = x.l + x.h * {}; *)
Definition c_inflate : const := (1, -87)%Z.
(* C src/metric/measure_filter.c dd_inflate
  out[0] = x.h;
  out[1] = x.l + x.h * 0x1p-87;
*)
Definition inflate (x : dd) : dd := (fst x, (snd x + fst x * lit c_inflate)%D).

(** ** No overflow *)

Definition small (e : Z) (x : double) : Prop := finite x /\ Rabs (val x) <= bpow radix2 e.

Lemma rnd_small e r : (-1074 <= e)%Z -> Rabs r <= bpow radix2 e -> Rabs (rnd r) <= bpow radix2 e.
Proof.
  intros E H. rewrite <- rnd_abs, <- (rnd_id (bpow radix2 e)); [now apply rnd_le|].
  apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Lemma bpow_twice e f g : (e < g)%Z -> (f < g)%Z -> bpow radix2 e + bpow radix2 f <= bpow radix2 g.
Proof.
  intros E F. replace g with (1 + (g - 1))%Z by lia. rewrite bpow_plus. change (bpow radix2 1) with 2.
  assert (bpow radix2 e <= bpow radix2 (g - 1)) by (apply bpow_le; lia).
  assert (bpow radix2 f <= bpow radix2 (g - 1)) by (apply bpow_le; lia). lra.
Qed.

Lemma below_max e r : (-1074 <= e < 1024)%Z -> Rabs r <= bpow radix2 e -> Rabs (rnd r) < bpow radix2 1024.
Proof.
  intros E H. apply Rle_lt_trans with (bpow radix2 e); [apply rnd_small; [lia|exact H]|apply bpow_lt; lia].
Qed.

Lemma small_add e f g x y : small e x -> small f y -> (e < g)%Z -> (f < g)%Z -> (-1074 <= g < 1024)%Z ->
  small g (x + y)%D /\ val (x + y)%D = rnd (val x + val y).
Proof.
  intros [Fx X] [Fy Y] E F G.
  assert (B : Rabs (val x + val y) <= bpow radix2 g).
  { apply Rle_trans with (1 := Rabs_triang _ _). pose proof (bpow_twice e f g E F). lra. }
  destruct (fadd_finite x y Fx Fy (below_max g _ G B)) as [Fi V]. split; [|exact V]. split; [exact Fi|].
  rewrite V. apply rnd_small; [lia|exact B].
Qed.

Lemma small_opp e x : small e x -> small e (- x)%D.
Proof. intros [F X]. split; [now rewrite fopp_finite|]. now rewrite fopp_val, Rabs_Ropp. Qed.

Lemma small_sub e f g x y : small e x -> small f y -> (e < g)%Z -> (f < g)%Z -> (-1074 <= g < 1024)%Z ->
  small g (x - y)%D /\ val (x - y)%D = rnd (val x - val y).
Proof.
  intros [Fx X] [Fy Y] E F G.
  assert (B : Rabs (val x - val y) <= bpow radix2 g).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. pose proof (bpow_twice e f g E F). lra. }
  destruct (fsub_finite x y Fx Fy (below_max g _ G B)) as [Fi V]. split; [|exact V]. split; [exact Fi|].
  rewrite V. apply rnd_small; [lia|exact B].
Qed.

Lemma product_small e f g s t : Rabs s <= bpow radix2 e -> Rabs t <= bpow radix2 f -> (e + f <= g)%Z ->
  Rabs (s * t) <= bpow radix2 g.
Proof.
  intros S T G. rewrite Rabs_mult. apply Rle_trans with (bpow radix2 e * bpow radix2 f).
  - apply Rmult_le_compat; try apply Rabs_pos; assumption.
  - rewrite <- bpow_plus. now apply bpow_le.
Qed.

Lemma small_mul e f g x y : small e x -> small f y -> (e + f <= g)%Z -> (-1074 <= g < 1024)%Z ->
  small g (x * y)%D /\ val (x * y)%D = rnd (val x * val y).
Proof.
  intros [Fx X] [Fy Y] E G. pose proof (product_small e f g _ _ X Y E) as B.
  destruct (fmul_finite x y Fx Fy (below_max g _ G B)) as [Fi V]. split; [|exact V]. split; [exact Fi|].
  rewrite V. apply rnd_small; [lia|exact B].
Qed.

Lemma small_fma e f g h x y z : small e x -> small f y -> small g z -> (e + f < h)%Z -> (g < h)%Z -> (-1074 <= h < 1024)%Z ->
  small h (ffma x y z) /\ val (ffma x y z) = rnd (val x * val y + val z).
Proof.
  intros [Fx X] [Fy Y] [Fz Z] E G H.
  assert (B : Rabs (val x * val y + val z) <= bpow radix2 h).
  { apply Rle_trans with (1 := Rabs_triang _ _). pose proof (product_small e f (e + f) _ _ X Y (Z.le_refl _)).
    pose proof (bpow_twice (e + f) g h E G). lra. }
  generalize (Bfma_correct 53 1024 (eq_refl : (0 < 53)%Z) (eq_refl : (53 < 1024)%Z) ternop_nan_pl64 mode_NE x y z Fx Fy Fz).
  change (SpecFloat.fexp 53 1024) with fexp; change (round_mode mode_NE) with ZnearestE. cbv zeta.
  fold (b64_fma mode_NE x y z). change (b64_fma mode_NE x y z) with (ffma x y z).
  rewrite Rlt_bool_true by (now apply (below_max h)). intros (V & Fi & _). split; [|exact V]. split; [exact Fi|].
  rewrite V. apply rnd_small; [lia|exact B].
Qed.

(** ** Exact sums *)

Lemma choice_even x : negb (Z.even x) = negb (negb (Z.even (- (x + 1)))).
Proof. rewrite Z.even_opp, Z.even_add. destruct (Z.even x); reflexivity. Qed.

Lemma two_sum_correct e a b : small e a -> small e b -> (-1074 <= e <= 1015)%Z ->
  finite (fst (two_sum a b)) /\ finite (snd (two_sum a b)) /\ val (fst (two_sum a b)) = rnd (val a + val b) /\
  val (fst (two_sum a b)) + val (snd (two_sum a b)) = val a + val b.
Proof.
  intros A B E. unfold two_sum. cbv zeta. cbn [fst snd].
  destruct (small_add e e (e + 1) a b A B) as [S Vs]; try lia. set (s := (a + b)%D) in *.
  destruct (small_sub (e + 1) e (e + 2) s a S A) as [T Vt]; try lia. set (t := (s - a)%D) in *.
  destruct (small_sub (e + 1) (e + 2) (e + 3) s t S T) as [X Vx]; try lia.
  destruct (small_sub e (e + 3) (e + 4) a (s - t)%D A X) as [Y Vy]; try lia.
  destruct (small_sub e (e + 2) (e + 4) b t B T) as [Z Vz]; try lia.
  destruct (small_add (e + 4) (e + 4) (e + 5) _ _ Y Z) as [R Vr]; try lia.
  split; [apply S|]. split; [apply R|]. split; [exact Vs|]. rewrite Vr, Vy, Vz, Vx, Vt, Vs.
  apply (Pff2Flocq.TwoSum_correct (-1074) 53 (fun x => negb (Z.even x))); try reflexivity; try apply val_format; try lia.
  apply choice_even.
Qed.

Lemma fast_two_sum_correct e a b : small e a -> small e b -> (-1074 <= e <= 1015)%Z -> Rabs (val b) <= Rabs (val a) ->
  finite (fst (fast_two_sum a b)) /\ finite (snd (fast_two_sum a b)) /\ val (fst (fast_two_sum a b)) = rnd (val a + val b) /\
  val (fst (fast_two_sum a b)) + val (snd (fast_two_sum a b)) = val a + val b.
Proof.
  intros A B E L. unfold fast_two_sum. cbv zeta. cbn [fst snd].
  destruct (small_add e e (e + 1) a b A B) as [S Vs]; try lia. set (s := (a + b)%D) in *.
  destruct (small_sub (e + 1) e (e + 2) s a S A) as [T Vt]; try lia.
  destruct (small_sub e (e + 2) (e + 3) b (s - a)%D B T) as [R Vr]; try lia.
  split; [apply S|]. split; [apply R|]. split; [exact Vs|]. rewrite Vr, Vt, Vs.
  replace (val b - rnd (rnd (val a + val b) - val a)) with (val b + rnd (val a - rnd (val a + val b))).
  - apply (Pff2Flocq.Fast2Sum_correct (-1074) 53 (fun x => negb (Z.even x))); try reflexivity; try apply val_format; try lia;
      [apply choice_even|exact L].
  - assert (N : rnd (val a - rnd (val a + val b)) = - rnd (rnd (val a + val b) - val a)).
    { rewrite <- round_NE_opp. f_equal. ring. }
    rewrite N. ring.
Qed.

(** ** Relative errors *)

(** x approximates v >= 0 with a relative error of k u^2. *)
Definition near (k : R) (x : dd) (v : R) : Prop :=
  finite (fst x) /\ finite (snd x) /\ 0 <= v /\ Rabs (val (fst x) + val (snd x) - v) <= k * (u * u) * v /\
  Rabs (val (snd x)) <= 1.01 * u * val (fst x).

Lemma near_weaken k k' x v : near k x v -> k <= k' -> near k' x v.
Proof.
  intros (F & G & P & N & L) K. repeat (split; [assumption|]). split; [|exact L]. apply Rle_trans with (1 := N).
  apply Rmult_le_compat_r; [exact P|]. apply Rmult_le_compat_r; [unfold u; lra|exact K].
Qed.

Lemma near_bounds k x v : near k x v -> k <= 1000 -> 0 <= val (fst x) <= 1.001 * v /\ v <= 1.001 * val (fst x).
Proof.
  intros (_ & _ & P & N & L) K. apply Rabs_le_inv in N. pose proof (Rabs_pos (val (snd x))) as L0. apply Rabs_le_inv in L.
  assert (k * (u * u) * v <= 1000 * (u * u) * v).
  { apply Rmult_le_compat_r; [exact P|]. apply Rmult_le_compat_r; [unfold u; lra|exact K]. }
  unfold u in *. lra.
Qed.

(** The last step of each operation: an exact addition, if the error term is small. *)
Lemma near_end e k a b v : small e a -> small e b -> (-1074 <= e <= 1015)%Z -> 0 <= val a -> Rabs (val b) <= 1 / 4 * val a ->
  0 <= v -> Rabs (val a + val b - v) <= k * (u * u) * v -> near k (fast_two_sum a b) v.
Proof.
  intros A B E Pa L Pv H. destruct (fast_two_sum_correct e a b A B E) as (F & G & V & S).
  { rewrite (Rabs_pos_eq (val a)) by exact Pa. lra. }
  split; [exact F|]. split; [exact G|]. split; [exact Pv|]. split; [now rewrite S|].
  apply Rabs_le_inv in L. pose proof (rnd_add_error (val a) (val b) (val_format a) (val_format b)) as Er.
  rewrite <- V in Er. rewrite (Rabs_pos_eq (val a + val b)) in Er by lra.
  replace (val (snd (fast_two_sum a b))) with (- (val (fst (fast_two_sum a b)) - (val a + val b))) by lra.
  rewrite Rabs_Ropp. apply Rabs_le_inv in Er as Er'. apply Rle_trans with (1 := Er). unfold u in *. lra.
Qed.

Lemma near_diff a b : small 1000 a -> small 1000 b -> val b <= val a -> near 0 (dd_sub_d a b) (val a - val b).
Proof.
  intros A B L. unfold dd_sub_d. destruct (two_sum_correct 1000 a (- b)%D A (small_opp _ _ B)) as (F & G & V & S); [lia|].
  rewrite fopp_val in V, S. split; [exact F|]. split; [exact G|]. split; [lra|].
  split; [replace (_ - _) with 0 by lra; rewrite Rabs_R0; lra|].
  pose proof (rnd_add_error (val a) (- val b) (val_format a) (format_opp _ (val_format b))) as Er.
  rewrite <- V in Er. rewrite (Rabs_pos_eq (val a + - val b)) in Er by lra.
  replace (val (snd (two_sum a (- b)))) with (- (val (fst (two_sum a (- b))) - (val a + - val b))) by lra.
  rewrite Rabs_Ropp. apply Rabs_le_inv in Er as Er'. apply Rle_trans with (1 := Er). unfold u in *. lra.
Qed.

Lemma near_small k x v e : near k x v -> k <= 1000 -> v <= bpow radix2 e -> small (e + 1) (fst x) /\ small (e + 1) (snd x).
Proof.
  intros N K V. destruct (near_bounds k x v N K) as [H _]. destruct N as (F & G & P & _ & L).
  assert (B : 2 * v <= bpow radix2 (e + 1)) by (rewrite Z.add_comm, bpow_plus; change (bpow radix2 1) with 2; lra).
  split; (split; [assumption|]).
  - rewrite Rabs_pos_eq; lra.
  - apply Rle_trans with (1 := L). unfold u. lra.
Qed.

Lemma near_add k x v y w : near k x v -> near k y w -> 0 <= k <= 900 -> v <= bpow radix2 900 -> w <= bpow radix2 900 ->
  near (k + 4) (dd_add x y) (v + w).
Proof.
  intros X Y K Vv Vw. assert (K' : k <= 1000) by lra.
  destruct (near_small k x v 900 X K' Vv) as [Xh Xl]. destruct (near_small k y w 900 Y K' Vw) as [Yh Yl].
  destruct (near_bounds k x v X K') as [Bx Bx']. destruct (near_bounds k y w Y K') as [By By'].
  destruct X as (_ & _ & Pv & Nx & Lx). destruct Y as (_ & _ & Pw & Ny & Ly).
  unfold dd_add. cbv zeta. change (900 + 1)%Z with 901%Z in *.
  destruct (two_sum_correct 901 _ _ Xh Yh) as (F & G & V & S); [lia|]. set (s := two_sum (fst x) (fst y)) in *.
  set (a := val (fst x) + val (fst y)) in *.
  assert (Pa : 0 <= a) by (unfold a; lra).
  pose proof (rnd_add_error (val (fst x)) (val (fst y)) (val_format _) (val_format _)) as Er. fold a in Er.
  rewrite <- V, (Rabs_pos_eq a) in Er by exact Pa. apply Rabs_le_inv in Er.
  assert (Ls : Rabs (val (snd s)) <= u * a) by (apply Rabs_le; lra).
  assert (P902 : 1.01 * a <= bpow radix2 902).
  { destruct Xh as [_ Xh], Yh as [_ Yh]. rewrite Rabs_pos_eq in Xh, Yh by lra.
    change 902%Z with (1 + 901)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. fold a in V. unfold a.
    pose proof (bpow_gt_0 radix2 901).
    (* a <= 2.01 * 2^900 *)
    assert (val (fst x) <= 1.001 * bpow radix2 900) by lra. assert (val (fst y) <= 1.001 * bpow radix2 900) by lra.
    replace 901%Z with (1 + 900)%Z in * by reflexivity. rewrite bpow_plus in *. change (bpow radix2 1) with 2 in *. lra. }
  assert (Ssm : small 902 (fst s) /\ small 902 (snd s)).
  { split; (split; [assumption|]).
    - rewrite Rabs_pos_eq; unfold u in *; lra.
    - apply Rle_trans with (1 := Ls). unfold u. lra. }
  destruct Ssm as [Sh Sl].
  destruct (small_add 901 901 902 _ _ Xl Yl) as [E1 V1]; try lia. set (e1 := (snd x + snd y)%D) in *.
  destruct (small_add 902 902 903 _ _ Sl E1) as [E2 V2]; try lia. set (e2 := (snd s + e1)%D) in *.
  pose proof (rnd_add_error (val (snd x)) (val (snd y)) (val_format _) (val_format _)) as Er1. rewrite <- V1 in Er1.
  pose proof (rnd_add_error (val (snd s)) (val e1) (val_format _) (val_format _)) as Er2. rewrite <- V2 in Er2.
  assert (Lc : Rabs (val (snd x) + val (snd y)) <= 1.01 * u * a).
  { apply Rle_trans with (1 := Rabs_triang _ _). unfold a. lra. }
  assert (Er1' : Rabs (val e1 - (val (snd x) + val (snd y))) <= 1.01 * (u * u) * a).
  { apply Rle_trans with (1 := Er1). replace (1.01 * (u * u) * a) with (u * (1.01 * u * a)) by ring.
    apply Rmult_le_compat_l; [unfold u; lra|exact Lc]. }
  assert (Le : Rabs (val e1) <= 1.02 * u * a).
  { replace (val e1) with ((val e1 - (val (snd x) + val (snd y))) + (val (snd x) + val (snd y))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). unfold u in *. lra. }
  assert (Lf : Rabs (val (snd s) + val e1) <= 2.02 * u * a) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  assert (Er2' : Rabs (val e2 - (val (snd s) + val e1)) <= 2.02 * (u * u) * a).
  { apply Rle_trans with (1 := Er2). replace (2.02 * (u * u) * a) with (u * (2.02 * u * a)) by ring.
    apply Rmult_le_compat_l; [unfold u; lra|exact Lf]. }
  assert (Lg : Rabs (val e2) <= 2.03 * u * a).
  { replace (val e2) with ((val e2 - (val (snd s) + val e1)) + (val (snd s) + val e1)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). unfold u in *. lra. }
  apply (near_end 903); [|exact E2|lia| | | |].
  - destruct Sh as [Fs Hs]. split; [exact Fs|]. apply Rle_trans with (1 := Hs). apply bpow_le. lia.
  - unfold u in *. lra.
  - apply Rle_trans with (1 := Lg). unfold u in *. lra.
  - lra.
  - apply Rabs_le_inv in Nx, Ny, Er1', Er2'. apply Rabs_le.
    assert (a <= 1.001 * (v + w)) by (unfold a; lra).
    assert ((u * u) * a <= (u * u) * (1.001 * (v + w))) by (apply Rmult_le_compat_l; [unfold u; lra|assumption]).
    assert (S' : val (fst s) + val (snd s) = a) by exact S.
    assert (0 <= (u * u) * (v + w)) by (apply Rmult_le_pos; [unfold u; lra|lra]).
    replace ((k + 4) * (u * u) * (v + w)) with (k * (u * u) * v + k * (u * u) * w + 4 * ((u * u) * (v + w))) by ring.
    unfold a in *. lra.
Qed.

(** ** Differences of any doubles, where the leading part is in range *)

Lemma coarse x : format x -> bpow radix2 999 <= Rabs x -> exists n, x = IZR n * bpow radix2 946.
Proof.
  intros F H. apply FLT_format_generic in F; [|typeclasses eauto]. destruct F as [[m e] -> M _]. cbn [Fnum Fexp] in *.
  assert (E : (946 <= e)%Z).
  { apply Znot_gt_le. intros G. revert H. apply Rlt_not_le. rewrite <- F2R_Zabs. unfold F2R, Fnum, Fexp.
    apply Rlt_le_trans with (bpow radix2 53 * bpow radix2 e).
    - apply Rmult_lt_compat_r; [apply bpow_gt_0|]. change (bpow radix2 53) with (IZR (2 ^ 53)). now apply IZR_lt.
    - rewrite <- bpow_plus. apply bpow_le. lia. }
  exists (m * 2 ^ (e - 946))%Z. unfold F2R, Fnum, Fexp. rewrite mult_IZR. change 2%Z with (radix_val radix2) at 1.
  rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
Qed.

Lemma far_apart a b : format a -> format b -> bpow radix2 1000 < Rabs a -> Rabs (a - b) <= bpow radix2 402 -> a = b.
Proof.
  intros Fa Fb A D. assert (Two : bpow radix2 1000 = 2 * bpow radix2 999) by (change 1000%Z with (1 + 999)%Z; now rewrite bpow_plus).
  assert (bpow radix2 402 < bpow radix2 946) by (apply bpow_lt; lia).
  assert (bpow radix2 946 < bpow radix2 999) by (apply bpow_lt; lia).
  assert (B : bpow radix2 999 <= Rabs b).
  { pose proof (Rabs_triang (a - b) b) as T. replace (a - b + b) with a in T by ring. lra. }
  destruct (coarse a Fa) as [m M]; [pose proof (bpow_gt_0 radix2 999); lra|]. destruct (coarse b Fb B) as [n N].
  destruct (Z.eq_dec m n) as [E|E]; [now rewrite M, N, E|]. exfalso. revert D. apply Rlt_not_le.
  rewrite M, N. replace (IZR m * bpow radix2 946 - IZR n * bpow radix2 946) with (IZR (m - n) * bpow radix2 946)
    by (rewrite minus_IZR; ring).
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 946)) by apply bpow_ge_0. rewrite <- abs_IZR.
  assert (1 <= IZR (Z.abs (m - n))) by (apply (IZR_le 1); lia). pose proof (bpow_gt_0 radix2 946).
  apply Rlt_le_trans with (1 * bpow radix2 946); [lra|]. apply Rmult_le_compat_r; lra.
Qed.

(** a - a, without a bound on a. *)
Lemma two_sum_zero a b : finite a -> finite b -> val b = - val a ->
  finite (fst (two_sum a b)) /\ finite (snd (two_sum a b)) /\ val (fst (two_sum a b)) = 0 /\ val (snd (two_sum a b)) = 0.
Proof.
  intros Fa Fb E. unfold two_sum. cbv zeta. cbn [fst snd].
  assert (R0 : rnd 0 = 0) by apply (round_0 radix2 fexp ZnearestE).
  assert (Max : forall r, r = 0 \/ r = val a \/ r = - val a -> Rabs (rnd r) < bpow radix2 1024 /\ rnd r = r).
  { intros r [-> | [-> | ->]].
    - rewrite R0, Rabs_R0. split; [apply bpow_gt_0|reflexivity].
    - rewrite rnd_id by apply val_format. split; [apply val_lt_max|reflexivity].
    - rewrite rnd_id by apply format_opp, val_format. rewrite Rabs_Ropp. split; [apply val_lt_max|reflexivity]. }
  destruct (fadd_finite a b Fa Fb) as [Fs Vs]; [apply Max; left; lra|]. set (s := (a + b)%D) in *.
  assert (Zs : val s = 0) by (rewrite Vs; replace (val a + val b) with 0 by lra; exact R0).
  destruct (fsub_finite s a Fs Fa) as [Ft Vt]; [apply Max; right; right; lra|]. set (t := (s - a)%D) in *.
  assert (Zt : val t = - val a) by (rewrite Vt, (proj2 (Max (val s - val a) ltac:(right; right; lra))); lra).
  destruct (fsub_finite s t Fs Ft) as [Fx Vx]; [apply Max; right; left; lra|].
  assert (Zx : val (s - t)%D = val a) by (rewrite Vx, (proj2 (Max (val s - val t) ltac:(right; left; lra))); lra).
  destruct (fsub_finite a (s - t)%D Fa Fx) as [Fy Vy]; [apply Max; left; lra|].
  assert (Zy : val (a - (s - t))%D = 0) by (rewrite Vy; replace (val a - val (s - t)%D) with 0 by lra; exact R0).
  destruct (fsub_finite b t Fb Ft) as [Fz Vz]; [apply Max; left; lra|].
  assert (Zz : val (b - t)%D = 0) by (rewrite Vz; replace (val b - val t) with 0 by lra; exact R0).
  destruct (fadd_finite _ _ Fy Fz) as [Fr Vr]; [apply Max; left; lra|].
  split; [exact Fs|]. split; [exact Fr|]. split; [exact Zs|]. rewrite Vr, Zy, Zz, Rplus_0_r. exact R0.
Qed.

Lemma diff_bound a b : finite a -> finite b -> finite (fst (dd_sub_d a b)) ->
  Rabs (val (fst (dd_sub_d a b))) <= bpow radix2 401 -> Rabs (val a - val b) <= bpow radix2 402.
Proof.
  intros Fa Fb F V. unfold dd_sub_d, two_sum in F, V. cbv zeta in F, V. cbn [fst] in F, V.
  destruct (fadd_inv _ _ F) as (_ & _ & E). rewrite fopp_val in E.
  pose proof (rnd_add_error (val a) (- val b) (val_format a) (format_opp _ (val_format b))) as Er. rewrite <- E in Er.
  change (val a + - val b) with (val a - val b) in Er. set (d := val a - val b) in *. set (s := val (a + - b)%D) in *.
  change 402%Z with (1 + 401)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2.
  assert (T : Rabs d <= Rabs s + Rabs (s - d)).
  { replace d with (s + - (s - d)) at 1 by ring. rewrite <- (Rabs_Ropp (s - d)). apply Rabs_triang. }
  pose proof (Rabs_pos d). unfold u in Er. lra.
Qed.

Lemma near_diff_any a b : finite a -> finite b -> val b <= val a -> finite (fst (dd_sub_d a b)) ->
  Rabs (val (fst (dd_sub_d a b))) <= bpow radix2 401 -> near 0 (dd_sub_d a b) (val a - val b).
Proof.
  intros Fa Fb L F V.
  destruct (Rle_or_lt (Rabs (val a)) (bpow radix2 1000)) as [A|A].
  - destruct (Rle_or_lt (Rabs (val b)) (bpow radix2 1000)) as [B|B]; [now apply near_diff|].
    assert (E : val b = val a).
    { apply far_apart; try apply val_format; [exact B|]. rewrite Rabs_minus_sym. now apply diff_bound. }
    rewrite E in B. lra.
  - assert (E : val a = val b) by (apply far_apart; try apply val_format; [exact A|now apply diff_bound]).
    unfold dd_sub_d. assert (Fo : finite (- b)%D) by (now rewrite fopp_finite).
    destruct (two_sum_zero a (- b)%D Fa Fo) as (H1 & H2 & H3 & H4); [rewrite fopp_val, E; ring|].
    split; [exact H1|]. split; [exact H2|]. split; [lra|]. rewrite H3, H4, E.
    replace (0 + 0 - (val b - val b)) with 0 by ring. rewrite !Rabs_R0. split; unfold u; lra.
Qed.
