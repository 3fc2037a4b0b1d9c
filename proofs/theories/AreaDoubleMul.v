(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Double-double products, and inflate, which makes an upper bound. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst AreaDouble.
Open Scope R_scope.

(** ** Ranges *)

Definition ranged (m e : Z) (v : R) : Prop := v = 0 \/ bpow radix2 m <= v <= bpow radix2 e.

Lemma ranged_top m e v : ranged m e v -> v <= bpow radix2 e.
Proof. intros [-> | H]; [apply bpow_ge_0|apply H]. Qed.

Lemma ranged_weaken m e m' e' v : ranged m e v -> (m' <= m)%Z -> (e <= e')%Z -> ranged m' e' v.
Proof.
  intros [-> | H] M E; [now left|right]. pose proof (bpow_le radix2 _ _ M). pose proof (bpow_le radix2 _ _ E). lra.
Qed.

Lemma ranged_add m e v w : ranged m e v -> ranged m e w -> ranged m (e + 1) (v + w).
Proof.
  intros V W. rewrite Z.add_comm with (n := e). unfold ranged. rewrite bpow_plus. change (bpow radix2 1) with 2.
  pose proof (bpow_gt_0 radix2 e). pose proof (bpow_gt_0 radix2 m). destruct V as [-> | V]; destruct W as [-> | W].
  - left; ring.
  - right; lra.
  - right; lra.
  - right; lra.
Qed.

Lemma ranged_mul m e m' e' v w : ranged m e v -> ranged m' e' w -> ranged (m + m') (e + e') (v * w).
Proof.
  intros [-> | V] [-> | W]; try (left; ring). right. rewrite !bpow_plus.
  pose proof (bpow_ge_0 radix2 m). pose proof (bpow_ge_0 radix2 m'). split; apply Rmult_le_compat; lra.
Qed.

(** ** Products *)

Lemma near_zero k x : near k x 0 -> val (fst x) = 0 /\ val (snd x) = 0.
Proof.
  intros (_ & _ & _ & N & L). rewrite Rmult_0_r in N. apply Rabs_le_inv in N. pose proof (Rabs_pos (val (snd x))).
  assert (0 <= val (fst x)) by (unfold u in L; lra). apply Rabs_le_inv in L. unfold u in *. lra.
Qed.

Lemma product_error x y xl yl e t1 t2 t3 t4 p : 0 <= x -> 0 <= y -> Rabs xl <= 1.01 * u * x -> Rabs yl <= 1.01 * u * y ->
  1000 * eta <= (u * u) * (x * y) -> p = rnd (x * y) -> e = rnd (x * y + - p) -> t1 = rnd (x * yl) -> t2 = rnd (xl * y) ->
  t3 = rnd (t1 + t2) -> t4 = rnd (e + t3) ->
  Rabs t4 <= 4 * u * (x * y) /\ Rabs (p + t4 - (x + xl) * (y + yl)) <= 10 * (u * u) * (x * y) /\ 0.99 * (x * y) <= p.
Proof.
  intros Px Py Lx Ly Et Hp He H1 H2 H3 H4. pose proof eta_pos as EP. set (m := x * y) in *.
  assert (Pm : 0 <= m) by (now apply Rmult_le_pos).
  assert (Q : 0 <= u * u * m) by (apply Rmult_le_pos; [unfold u; lra|exact Pm]).
  assert (A : Rabs (p - m) <= 1.01 * u * m).
  { rewrite Hp. apply Rle_trans with (1 := rnd_error m). rewrite (Rabs_pos_eq m) by exact Pm. unfold u in *. lra. }
  assert (B : Rabs (e - (m - p)) <= 1.02 * (u * u) * m).
  { rewrite He. apply Rle_trans with (1 := rnd_error (m + - p)). replace (m + - p) with (- (p - m)) by ring.
    rewrite Rabs_Ropp. unfold u in *. lra. }
  assert (C1 : Rabs (x * yl) <= 1.01 * u * m).
  { rewrite Rabs_mult, (Rabs_pos_eq x) by exact Px. replace (1.01 * u * m) with (x * (1.01 * u * y)) by (unfold m; ring).
    now apply Rmult_le_compat_l. }
  assert (C2 : Rabs (xl * y) <= 1.01 * u * m).
  { rewrite Rabs_mult, (Rabs_pos_eq y) by exact Py. replace (1.01 * u * m) with (1.01 * u * x * y) by (unfold m; ring).
    now apply Rmult_le_compat_r. }
  assert (D1 : Rabs (t1 - x * yl) <= 1.02 * (u * u) * m).
  { rewrite H1. apply Rle_trans with (1 := rnd_error (x * yl)). unfold u in *. lra. }
  assert (D2 : Rabs (t2 - xl * y) <= 1.02 * (u * u) * m).
  { rewrite H2. apply Rle_trans with (1 := rnd_error (xl * y)). unfold u in *. lra. }
  assert (F1 : format t1) by (rewrite H1; apply rnd_format). assert (F2 : format t2) by (rewrite H2; apply rnd_format).
  assert (F3 : format t3) by (rewrite H3; apply rnd_format). assert (Fe : format e) by (rewrite He; apply rnd_format).
  pose proof (rnd_add_error t1 t2 F1 F2) as D3. rewrite <- H3 in D3.
  pose proof (rnd_add_error e t3 Fe F3) as D4. rewrite <- H4 in D4.
  apply Rabs_le_inv in A, B, C1, C2, D1, D2.
  assert (S3 : Rabs (t1 + t2) <= 2.04 * u * m) by (apply Rabs_le; unfold u in *; lra).
  assert (D3' : Rabs (t3 - (t1 + t2)) <= 2.04 * (u * u) * m) by (unfold u in *; lra).
  apply Rabs_le_inv in S3, D3'.
  assert (S4 : Rabs (e + t3) <= 3.1 * u * m) by (apply Rabs_le; unfold u in *; lra).
  assert (D4' : Rabs (t4 - (e + t3)) <= 3.1 * (u * u) * m) by (unfold u in *; lra).
  apply Rabs_le_inv in S4, D4'.
  assert (X : Rabs (xl * yl) <= 1.03 * (u * u) * m).
  { rewrite Rabs_mult. apply Rle_trans with (1.01 * u * x * (1.01 * u * y)).
    - apply Rmult_le_compat; try apply Rabs_pos; assumption.
    - replace (1.01 * u * x * (1.01 * u * y)) with (1.01 * 1.01 * (u * u * m)) by (unfold m; ring).
      replace (1.03 * (u * u) * m) with (1.03 * (u * u * m)) by ring. apply Rmult_le_compat_r; [exact Q|lra]. }
  apply Rabs_le_inv in X. split; [apply Rabs_le; unfold u in *; lra|]. split; [|unfold u in *; lra].
  apply Rabs_le. replace ((x + xl) * (y + yl)) with (m + x * yl + xl * y + xl * yl) by (unfold m; ring).
  unfold u in *. lra.
Qed.

Lemma eta_least : 1000 * eta <= (u * u) * (0.9 * bpow radix2 (-820)).
Proof.
  assert (E : bpow radix2 (-820) = bpow radix2 255 * eta) by (rewrite bpow_eta; reflexivity). rewrite E.
  pose proof eta_pos. assert (bpow radix2 130 <= bpow radix2 255) by (apply bpow_le; lia).
  assert (B : 1361129467683753853853498429727072845824 <= bpow radix2 255).
  { change 1361129467683753853853498429727072845824 with (bpow radix2 130). assumption. }
  assert (1361129467683753853853498429727072845824 * eta <= bpow radix2 255 * eta) by (apply Rmult_le_compat_r; lra).
  unfold u. lra.
Qed.

Lemma product_near k a b v w : 0 <= v -> 0 <= w -> 0 <= k <= 400 -> Rabs (a - v) <= k * (u * u) * v ->
  Rabs (b - w) <= k * (u * u) * w -> Rabs (a * b - v * w) <= (2 * k + 1) * (u * u) * (v * w).
Proof.
  intros Pv Pw K A B. set (r := k * (u * u)) in *.
  assert (Pr : 0 <= r <= 0.001) by (unfold r, u; split; [apply Rmult_le_pos; lra|lra]).
  replace (a * b - v * w) with ((a - v) * w + v * (b - w) + (a - v) * (b - w)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _).
  apply Rle_trans with (Rabs ((a - v) * w) + Rabs (v * (b - w)) + Rabs ((a - v) * (b - w))).
  { apply Rplus_le_compat_r, Rabs_triang. }
  rewrite !Rabs_mult, (Rabs_pos_eq v), (Rabs_pos_eq w) by assumption.
  assert (H1 : Rabs (a - v) * w <= r * v * w) by (now apply Rmult_le_compat_r).
  assert (H2 : v * Rabs (b - w) <= v * (r * w)) by (now apply Rmult_le_compat_l).
  assert (H3 : Rabs (a - v) * Rabs (b - w) <= r * v * (r * w)) by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
  assert (Pvw : 0 <= v * w) by (now apply Rmult_le_pos).
  assert (H4 : r * v * (r * w) <= (u * u) * (v * w)).
  { replace (r * v * (r * w)) with (r * r * (v * w)) by ring. apply Rmult_le_compat_r; [exact Pvw|].
    unfold r. replace (k * (u * u) * (k * (u * u))) with (k * k * (u * u) * (u * u)) by ring.
    rewrite <- (Rmult_1_l (u * u)) at 3. apply Rmult_le_compat_r; [unfold u; lra|].
    assert (k * k <= 400 * 400) by (apply Rmult_le_compat; lra). unfold u; lra. }
  replace ((2 * k + 1) * (u * u) * (v * w)) with (r * v * w + v * (r * w) + u * u * (v * w)) by (unfold r; ring). lra.
Qed.

Lemma near_mul k x v y w : near k x v -> near k y w -> 0 <= k <= 400 -> ranged (-410) 410 v -> ranged (-410) 410 w ->
  near (2 * k + 13) (dd_mul x y) (v * w).
Proof.
  intros X Y K Rv Rw. assert (K' : k <= 1000) by lra.
  destruct (near_small k x v 410 X K' (ranged_top _ _ _ Rv)) as [Xh Xl].
  destruct (near_small k y w 410 Y K' (ranged_top _ _ _ Rw)) as [Yh Yl].
  destruct (near_bounds k x v X K') as [Bx Bx']. destruct (near_bounds k y w Y K') as [By By'].
  change (410 + 1)%Z with 411%Z in *. unfold dd_mul. cbv zeta.
  destruct (small_mul 411 411 822 _ _ Xh Yh) as [P Vp]; try lia. set (p := (fst x * fst y)%D) in *.
  destruct (small_fma 411 411 822 823 _ _ _ Xh Yh (small_opp _ _ P)) as [E Ve]; try lia.
  set (e := ffma (fst x) (fst y) (- p)%D) in *. rewrite fopp_val in Ve.
  destruct (small_mul 411 411 822 _ _ Xh Yl) as [T1 V1]; try lia. destruct (small_mul 411 411 822 _ _ Xl Yh) as [T2 V2]; try lia.
  destruct (small_add 822 822 823 _ _ T1 T2) as [T3 V3]; try lia.
  destruct (small_add 823 823 824 _ _ E T3) as [T4 V4]; try lia.
  set (t4 := (e + (fst x * snd y + snd x * fst y))%D) in *.
  assert (Sp : small 824 p). { destruct P as [Fp Lp]. split; [exact Fp|]. apply Rle_trans with (1 := Lp). apply bpow_le. lia. }
  assert (Pv : 0 <= v) by apply X. assert (Pw : 0 <= w) by apply Y.
  assert (Zero : val (fst x) * val (fst y) = 0 -> v * w = 0 -> val (snd x) * val (fst y) = 0 -> val (fst x) * val (snd y) = 0 ->
    near (2 * k + 13) (fast_two_sum p t4) (v * w)).
  { intros Z0 Z1 Z2 Z3. assert (R0 : rnd 0 = 0) by apply (round_0 radix2 fexp ZnearestE).
    assert (Zp : val p = 0) by (rewrite Vp, Z0; exact R0).
    assert (Zt : val t4 = 0).
    { rewrite V4, Ve, V3, V1, V2, Z0, Z2, Z3, Zp. rewrite !R0, Ropp_0, !Rplus_0_r, !R0, Rplus_0_r. exact R0. }
    apply (near_end 824); try assumption; try lia; rewrite ?Zp, ?Zt, ?Z1, ?Rabs_R0; try lra.
    replace (0 + 0 - 0) with 0 by ring. rewrite Rabs_R0. lra. }
  destruct Rv as [Zv | Rv].
  { subst v. destruct (near_zero k x X) as [A B]. apply Zero; rewrite ?A, ?B; ring. }
  destruct Rw as [Zw | Rw].
  { subst w. destruct (near_zero k y Y) as [A B]. apply Zero; rewrite ?A, ?B; ring. }
  destruct X as (_ & _ & _ & Nx & Lx). destruct Y as (_ & _ & _ & Ny & Ly).
  assert (M : 0.9 * bpow radix2 (-820) <= val (fst x) * val (fst y)).
  { change (-820)%Z with (-410 + -410)%Z. rewrite bpow_plus. pose proof (bpow_gt_0 radix2 (-410)).
    replace (0.9 * (bpow radix2 (-410) * bpow radix2 (-410))) with (0.9 * bpow radix2 (-410) * bpow radix2 (-410)) by ring.
    set (t := bpow radix2 (-410)) in *. assert (0 < t * t) by (now apply Rmult_lt_0_compat).
    apply Rle_trans with (0.95 * t * (0.95 * t)); [lra|].
    apply Rmult_le_compat; lra. }
  assert (Et : 1000 * eta <= u * u * (val (fst x) * val (fst y))).
  { apply Rle_trans with (1 := eta_least). apply Rmult_le_compat_l; [unfold u; lra|exact M]. }
  destruct (product_error (val (fst x)) (val (fst y)) (val (snd x)) (val (snd y)) (val e) (val (fst x * snd y)%D)
    (val (snd x * fst y)%D) (val (fst x * snd y + snd x * fst y)%D) (val t4) (val p)) as (A & B & C); try assumption; try lra.
  set (m := val (fst x) * val (fst y)) in *.
  assert (Pm : 0 <= m) by (pose proof (bpow_gt_0 radix2 (-820)); lra).
  apply (near_end 824); try assumption; try lia; try lra.
  - apply Rle_trans with (1 := A). unfold u. lra.
  - now apply Rmult_le_pos.
  - pose proof (product_near k _ _ v w Pv Pw K Nx Ny) as D.
    assert (Mv : m <= 1.01 * (v * w)).
    { apply Rle_trans with (1.001 * v * (1.001 * w)); [apply Rmult_le_compat; lra|].
      assert (0 <= v * w) by (now apply Rmult_le_pos). lra. }
    assert (Q : u * u * m <= u * u * (1.01 * (v * w))) by (apply Rmult_le_compat_l; [unfold u; lra|exact Mv]).
    assert (0 <= u * u * (v * w)) by (apply Rmult_le_pos; [unfold u; lra|now apply Rmult_le_pos]).
    apply Rabs_le_inv in B, D. apply Rabs_le.
    replace ((2 * k + 13) * (u * u) * (v * w)) with ((2 * k + 1) * (u * u) * (v * w) + 12 * (u * u * (v * w))) by ring.
    split; lra.
Qed.

(** ** An upper bound *)

Theorem inflate_above k x v : near k x v -> k <= 1000 -> ranged (-810) 900 v ->
  finite (fst (inflate x)) /\ finite (snd (inflate x)) /\
  v <= val (fst (inflate x)) + val (snd (inflate x)) <= (1 + bpow radix2 (-86)) * v.
Proof.
  intros X K Rv. destruct (near_small k x v 900 X K (ranged_top _ _ _ Rv)) as [H L].
  destruct (near_bounds k x v X K) as [B B']. change (900 + 1)%Z with 901%Z in *. unfold inflate. cbn [fst snd].
  destruct (lit_correct c_inflate eq_refl) as [Fc Vc]. assert (C : cval c_inflate = 524288 * (u * u)) by (unfold u, c_inflate; numerals; lra).
  assert (Sc : small 0 (lit c_inflate)).
  { split; [exact Fc|]. rewrite Vc, C, Rabs_pos_eq by (unfold u; lra). change (bpow radix2 0) with 1. unfold u; lra. }
  destruct (small_mul 901 0 901 _ _ H Sc) as [Z Vz]; try lia. destruct (small_add 901 901 902 _ _ L Z) as [O Vo]; try lia.
  split; [apply H|]. split; [apply O|].
  assert (C86 : bpow radix2 (-86) = 1048576 * (u * u)) by (unfold u; numerals; lra). rewrite C86, Vo. rewrite Vc, C in Vz.
  set (z := val (fst x * lit c_inflate)%D) in *. set (h := val (fst x)) in *.
  destruct Rv as [Zv | [Rv _]].
  { subst v. destruct (near_zero k x X) as [A A']. fold h in A. rewrite A in Vz. rewrite Rmult_0_l in Vz.
    rewrite (round_0 radix2 fexp ZnearestE) in Vz. rewrite Vz, A, A', !Rplus_0_l, (round_0 radix2 fexp ZnearestE). lra. }
  destruct X as (_ & _ & Pv & N & Lx). fold h in N, Lx.
  assert (Et : eta <= u * u * h).
  { pose proof eta_least as E. assert (bpow radix2 (-820) <= bpow radix2 (-810)) by (apply bpow_le; lia). pose proof eta_pos.
    pose proof (bpow_gt_0 radix2 (-820)).
    assert (u * u * (0.9 * bpow radix2 (-820)) <= u * u * h) by (apply Rmult_le_compat_l; [unfold u; lra|lra]). lra. }
  assert (Z1 : h * (524288 * (u * u)) * (1 - u) - eta <= z) by (rewrite Vz; apply rnd_lower, Rmult_le_pos; [lra|unfold u; lra]).
  assert (Z2 : z <= h * (524288 * (u * u)) * (1 + u) + eta) by (rewrite Vz; apply rnd_upper, Rmult_le_pos; [lra|unfold u; lra]).
  pose proof (rnd_add_error (val (snd x)) z (val_format _) (val_format _)) as Er.
  assert (Lz : Rabs (val (snd x) + z) <= 1.02 * u * h).
  { apply Rabs_le_inv in Lx. apply Rabs_le. unfold u in *. lra. }
  assert (Er' : Rabs (rnd (val (snd x) + z) - (val (snd x) + z)) <= 1.02 * (u * u) * h) by (unfold u in *; lra).
  apply Rabs_le_inv in Er', N.
  assert (k * (u * u) * v <= 1000 * (u * u) * v).
  { apply Rmult_le_compat_r; [exact Pv|]. apply Rmult_le_compat_r; [unfold u; lra|exact K]. }
  unfold u in *. lra.
Qed.
