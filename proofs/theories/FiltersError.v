(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** Error bounds of rounded expressions: x' approximates x with |x| <= m when |x' - x| <= ((1+u)^k - 1) m + h. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Relative Plus_error.
From Dyadel Require Import FiltersBase.
Open Scope R_scope.

(** Half a unit in the last place of 1, and half of the least subnormal. *)
Definition u : R := / 9007199254740992.
Definition eta : R := bpow radix2 (-1075).

Lemma eta_pos : 0 < eta.
Proof. apply bpow_gt_0. Qed.
Lemma bpow_eta e : bpow radix2 e = bpow radix2 (e + 1075) * eta.
Proof. unfold eta; rewrite <- bpow_plus; f_equal; lia. Qed.

Lemma rnd_format x : format (rnd x).
Proof. apply generic_format_round; typeclasses eauto. Qed.
#[global] Hint Resolve rnd_format : core.

Lemma rnd_le x y : x <= y -> rnd x <= rnd y.
Proof. apply round_le; typeclasses eauto. Qed.
Lemma rnd_id x : format x -> rnd x = x.
Proof. intros H; apply round_generic; [typeclasses eauto|exact H]. Qed.
Lemma rnd_abs x : rnd (Rabs x) = Rabs (rnd x).
Proof. apply round_NE_abs; typeclasses eauto. Qed.

Lemma rnd_error x : Rabs (rnd x - x) <= u * Rabs x + eta.
Proof.
  destruct (relative_error_N_FLT'_ex radix2 (-1074) 53 eq_refl (fun n => negb (Z.even n)) x) as (d & e & D & E & _ &
    ->).
  assert (U : u_ro radix2 53 = u) by (unfold u_ro, u; simpl; lra). rewrite U in D.
  assert (D' : Rabs d <= u).
  { apply Rle_trans with (1 := D). assert (0 < u) by (unfold u; lra).
    apply Rmult_le_reg_r with (1 + u); [lra|]. unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra. nra. }
  assert (E' : Rabs e <= eta).
  { apply Rle_trans with (1 := E); right; unfold eta. change (/ 2) with (bpow radix2 (-1)). now rewrite <- bpow_plus. }
  replace (x * (1 + d) + e - x) with (x * d + e) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_mult.
  apply Rplus_le_compat; [|exact E']. rewrite Rmult_comm; apply Rmult_le_compat_r; [apply Rabs_pos|exact D'].
Qed.

Lemma rnd_add_error x y : format x -> format y -> Rabs (rnd (x + y) - (x + y)) <= u * Rabs (x + y).
Proof.
  intros Fx Fy.
  destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun n => negb (Z.even n)) x y Fx Fy) as (d & D & ->).
  assert (U : u_ro radix2 53 = u) by (unfold u_ro, u; simpl; lra). rewrite U in D.
  assert (D' : Rabs d <= u).
  { apply Rle_trans with (1 := D). assert (0 < u) by (unfold u; lra).
    apply Rmult_le_reg_r with (1 + u); [lra|]. unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra. nra. }
  replace ((x + y) * (1 + d) - (x + y)) with (d * (x + y)) by ring.
  rewrite Rabs_mult; apply Rmult_le_compat_r; [apply Rabs_pos|exact D'].
Qed.

Lemma format_opp x : format x -> format (- x).
Proof. apply generic_format_opp. Qed.

Lemma rnd_sub_error x y : format x -> format y -> Rabs (rnd (x - y) - (x - y)) <= u * Rabs (x - y).
Proof. intros Fx Fy; apply rnd_add_error; [exact Fx|now apply format_opp]. Qed.

(** ** Running errors *)

Definition app (k : nat) (h m x' x : R) : Prop := Rabs x <= m /\ Rabs (x' - x) <= ((1 + u) ^ k - 1) * m + h.

Lemma u_pos : 0 < u.
Proof. unfold u; lra. Qed.

Lemma pow_ge_1 k : 1 <= (1 + u) ^ k.
Proof. apply pow_R1_Rle. generalize u_pos; lra. Qed.

Lemma app_magnitude k h m x' x : app k h m x' x -> Rabs x' <= (1 + u) ^ k * m + h.
Proof.
  intros [A B]. replace x' with (x + (x' - x)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma app_m_pos k h m x' x : app k h m x' x -> 0 <= m.
Proof. intros [A _]; generalize (Rabs_pos x); lra. Qed.

Lemma app_weaken k k' h h' m m' x' x : app k h m x' x -> (k <= k')%nat -> h <= h' -> m <= m' -> app k' h' m' x' x.
Proof.
  intros [A B] K H M; split; [lra|].
  apply Rle_trans with (1 := B). apply Rplus_le_compat; [|exact H].
  assert (0 <= m) by (generalize (Rabs_pos x); lra). generalize (pow_ge_1 k); intros P.
  apply Rmult_le_compat; try lra. generalize u_pos; intros.
  apply Rplus_le_compat_r, Rle_pow; [lra|exact K].
Qed.

Lemma app_exact x : app 0 0 (Rabs x) x x.
Proof. split; [lra|]. simpl. rewrite Rminus_eq_0, Rabs_R0; lra. Qed.

(** A sum that is not rounded. *)
Lemma app_plus k h1 h2 m1 m2 x' x y' y : app k h1 m1 x' x -> app k h2 m2 y' y ->
  app k (h1 + h2) (m1 + m2) (x' + y') (x + y).
Proof.
  intros [A B] [C D]; split.
  - apply Rle_trans with (1 := Rabs_triang _ _); lra.
  - replace (x' + y' - (x + y)) with ((x' - x) + (y' - y)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _); lra.
Qed.

Lemma app_opp k h m x' x : app k h m x' x -> app k h m (- x') (- x).
Proof.
  intros [A B]; split; [now rewrite Rabs_Ropp|].
  replace (- x' - - x) with (- (x' - x)) by ring. now rewrite Rabs_Ropp.
Qed.

Lemma app_round_sum k h m x' x : Rabs (rnd x' - x') <= u * Rabs x' -> app k h m x' x ->
  app (S k) ((1 + u) * h) m (rnd x') x.
Proof.
  intros E A; pose proof (app_magnitude _ _ _ _ _ A) as M; destruct A as [A B]; split; [exact A|].
  replace (rnd x' - x) with ((rnd x' - x') + (x' - x)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _).
  generalize u_pos; intros U.
  assert (u * Rabs x' <= u * ((1 + u) ^ k * m + h)) by (apply Rmult_le_compat_l; lra).
  simpl; nra.
Qed.

Lemma app_add k h1 h2 m1 m2 x' x y' y : format x' -> format y' -> app k h1 m1 x' x -> app k h2 m2 y' y ->
  app (S k) ((1 + u) * (h1 + h2)) (m1 + m2) (rnd (x' + y')) (x + y).
Proof. intros Fx Fy A B; apply app_round_sum; [now apply rnd_add_error|now apply app_plus]. Qed.

Lemma app_sub k h1 h2 m1 m2 x' x y' y : format x' -> format y' -> app k h1 m1 x' x -> app k h2 m2 y' y ->
  app (S k) ((1 + u) * (h1 + h2)) (m1 + m2) (rnd (x' - y')) (x - y).
Proof.
  intros Fx Fy A B; apply app_round_sum; [now apply rnd_sub_error|].
  apply app_plus; [exact A|now apply app_opp].
Qed.

(** A difference of doubles, with its exact value as magnitude. *)
Lemma app_diff x y : format x -> format y -> app 1 0 (Rabs (x - y)) (rnd (x - y)) (x - y).
Proof.
  intros Fx Fy; split; [lra|]. generalize (rnd_sub_error x y Fx Fy); simpl; lra.
Qed.

(** A product that is not rounded. *)
Lemma app_times k l h1 h2 m1 m2 x' x y' y : 0 <= h1 -> 0 <= h2 -> app k h1 m1 x' x -> app l h2 m2 y' y ->
  app (k + l) (h1 * ((1 + u) ^ l * m2) + h2 * ((1 + u) ^ k * m1) + h1 * h2) (m1 * m2) (x' * y') (x * y).
Proof.
  intros P1 P2 A B; pose proof (app_magnitude _ _ _ _ _ A) as MA; pose proof (app_m_pos _ _ _ _ _ A).
  pose proof (app_m_pos _ _ _ _ _ B). destruct A as [A A'], B as [B B']; split.
  - rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; assumption.
  - replace (x' * y' - x * y) with (x' * (y' - y) + (x' - x) * y) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
    assert (E1 : Rabs x' * Rabs (y' - y) <= ((1 + u) ^ k * m1 + h1) * (((1 + u) ^ l - 1) * m2 + h2))
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    assert (E2 : Rabs (x' - x) * Rabs y <= (((1 + u) ^ k - 1) * m1 + h1) * m2)
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    rewrite pow_add. nra.
Qed.

Lemma app_mul k l h1 h2 m1 m2 x' x y' y : 0 <= h1 -> 0 <= h2 -> app k h1 m1 x' x -> app l h2 m2 y' y ->
  app (S (k + l)) ((1 + u) * (h1 * ((1 + u) ^ l * m2) + h2 * ((1 + u) ^ k * m1) + h1 * h2) + eta) (m1 * m2)
    (rnd (x' * y')) (x * y).
Proof.
  intros P1 P2 A B; pose proof (app_times _ _ _ _ _ _ _ _ _ _ P1 P2 A B) as C.
  pose proof (app_magnitude _ _ _ _ _ C) as M; destruct C as [C C']; split; [exact C|].
  replace (rnd (x' * y') - x * y) with ((rnd (x' * y') - x' * y') + (x' * y' - x * y)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). generalize (rnd_error (x' * y')); intros E.
  generalize u_pos; intros U.
  set (H := h1 * ((1 + u) ^ l * m2) + h2 * ((1 + u) ^ k * m1) + h1 * h2) in *.
  assert (u * Rabs (x' * y') <= u * ((1 + u) ^ (k + l) * (m1 * m2) + H)) by (apply Rmult_le_compat_l; lra).
  change ((1 + u) ^ S (k + l)) with ((1 + u) * (1 + u) ^ (k + l)). nra.
Qed.

(** Products of differences: nothing but the underflow of the product itself. *)
Lemma app_mul0 k l m1 m2 x' x y' y : app k 0 m1 x' x -> app l 0 m2 y' y ->
  app (S (k + l)) eta (m1 * m2) (rnd (x' * y')) (x * y).
Proof.
  intros A B; eapply app_weaken; [eapply app_mul; [| |exact A|exact B]; lra|lia|right; ring|lra].
Qed.

(** ** Bounds from below of rounded numbers that are not negative *)

Lemma rnd_lower x : 0 <= x -> x * (1 - u) - eta <= rnd x.
Proof.
  intros H; generalize (rnd_error x); intros E; rewrite (Rabs_pos_eq x) in E by exact H.
  generalize (Rle_abs (- (rnd x - x))); rewrite Rabs_Ropp; lra.
Qed.
Lemma rnd_upper x : 0 <= x -> rnd x <= x * (1 + u) + eta.
Proof.
  intros H; generalize (rnd_error x); intros E; rewrite (Rabs_pos_eq x) in E by exact H.
  generalize (Rle_abs (rnd x - x)); lra.
Qed.
Lemma rnd_add_lower x y : format x -> format y -> 0 <= x + y -> (x + y) * (1 - u) <= rnd (x + y).
Proof.
  intros Fx Fy H; generalize (rnd_add_error x y Fx Fy); intros E; rewrite (Rabs_pos_eq (x + y)) in E by exact H.
  generalize (Rle_abs (- (rnd (x + y) - (x + y)))); rewrite Rabs_Ropp; lra.
Qed.
Lemma rnd_add_upper x y : format x -> format y -> 0 <= x + y -> rnd (x + y) <= (x + y) * (1 + u).
Proof.
  intros Fx Fy H; generalize (rnd_add_error x y Fx Fy); intros E; rewrite (Rabs_pos_eq (x + y)) in E by exact H.
  generalize (Rle_abs (rnd (x + y) - (x + y))); lra.
Qed.

(** Products by a constant are kept as they are. *)
Lemma rnd_pos x : 0 <= x -> 0 <= rnd x.
Proof. exact (rnd_ge_0 x). Qed.

(** A computed value beyond its error bound has the sign of the exact one. *)
Lemma conclude d' d0 d1 b1 b2 e : Rabs (d' - d0) <= b1 -> Rabs (d1 - d0) <= b2 -> b1 + b2 < e ->
  (e < d' -> 0 < d1) /\ (d' < - e -> d1 < 0).
Proof.
  intros A B C; apply Rabs_le_inv in A; apply Rabs_le_inv in B. split; intros D; lra.
Qed.
