(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-FAR] Farther from a whole box than another one: differences of squared distances in interval arithmetic. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core Binary Mult_error.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersDirectionBox FiltersInterval
  FiltersIntervalSign FiltersIntervalRoot.
Open Scope R_scope.

(* [FLT-FAR] src/legal/witness_filter.c: twice = {{} * c.lo, *)
(* [FLT-FAR] src/legal/witness_filter.c: twice = {2 * c.lo, {} * c.hi}; *)
Definition c_far_two : const := (1, 1)%Z.
(* The rest of that file guesses; its result is proved [LEG-1] [WIT-FLT]: *)
(* any src/legal/witness_filter.c: noise = q->size * {}; *)
(* any src/legal/witness_filter.c: bound <= {}; bound *)
(* C src/legal/witness_filter.c farther_along
  dyd_iv q = {dyd_max(k0, dyd_min(c.lo, k1)), dyd_min(k1, dyd_max(c.hi, k0))}, twice = {2 * c.lo, 2 * c.hi};
  double low[2];
  for (int end = 0; end < 2; end++) {
    dyd_iv p = dyd_iv_point(end ? s1 : s0);
    low[end] = dyd_iv_mul(dyd_iv_sub(q, p), dyd_iv_sub(dyd_iv_add(q, p), twice)).lo;
  }
  return low[0] < low[1] ? low[0] : low[1] <= low[0] ? low[1] : NAN;
*)
Definition far_q (c : iv) (k0 k1 : double) : iv := {| lo := fmax k0 (fmin (lo c) k1); hi := fmin k1 (fmax (hi c) k0) |}.
Definition far_twice (c : iv) : iv := {| lo := (lit c_far_two * lo c)%D; hi := (lit c_far_two * hi c)%D |}.
Definition far_low (q twice : iv) (s : double) : double :=
  lo (iv_mul (iv_sub q (iv_point s)) (iv_sub (iv_add q (iv_point s)) twice)).
Definition farther_along (c : iv) (s0 s1 k0 k1 : double) : double :=
  let low0 := far_low (far_q c k0 k1) (far_twice c) s0 in let low1 := far_low (far_q c k0 k1) (far_twice c) s1 in
  if lt low0 low1 then low0 else if le low1 low0 then low1 else nan.
(* C src/legal/witness_filter.c dyd_filter_is_farther
  const double *a = c->e, *p = s->e, *q = k->e;
  double x = farther_along((dyd_iv){a[0], a[1]}, p[0], p[1], q[0], q[1]);
  double y = farther_along((dyd_iv){a[2], a[3]}, p[2], p[3], q[2], q[3]);
  return dyd_down(x + y) > 0;
*)
Definition is_farther (c s k : bbox) : bool :=
  let x := farther_along {| lo := e0 c; hi := e1 c |} (e0 s) (e1 s) (e0 k) (e1 k) in
  let y := farther_along {| lo := e2 c; hi := e3 c |} (e2 s) (e3 s) (e2 k) (e3 k) in
  gt (down (x + y)) (lit c_zero).

(** ** Ends, and their doubles *)

Lemma lower_below f x : lower_end f x -> below f x.
Proof. intros [->|[F H]]; (split; [|intros G; try discriminate G]); [discriminate|intros E; rewrite E in F;
  discriminate|exact H]. Qed.
Lemma upper_above f x : upper_end f x -> above f x.
Proof. intros [->|[F H]]; (split; [|intros G; try discriminate G]); [discriminate|intros E; rewrite E in F;
  discriminate|exact H]. Qed.

(** The larger of two that are below x is; the smaller is when one is, and the other a number. *)
Lemma below_max f g x : below f x -> below g x -> below (fmax f g) x.
Proof. unfold fmax. destruct (gt f g); tauto. Qed.
Lemma above_min f g x : above f x -> above g x -> above (fmin f g) x.
Proof. unfold fmin. destruct (lt f g); tauto. Qed.

Lemma below_min f g x y : lower_end f x -> upper_end g y -> below (fmin f g) x.
Proof.
  intros L U. unfold fmin. pose proof (lower_below _ _ L) as B. destruct (lt f g) eqn:E; [exact B|].
  destruct L as [->|[F L]].
  - destruct U as [->|[G _]]; [discriminate|]. destruct g; discriminate.
  - destruct U as [->|[G _]]; [destruct f; discriminate|]. split; [intros K; rewrite K in G; discriminate|]. intros _.
    generalize (proj2 (lt_finite f g F G)). rewrite E. intros K. destruct (Rle_or_lt (val g) (val f)) as [M|M]; [lra|].
    discriminate (K M).
Qed.
Lemma above_max f g x y : upper_end f x -> lower_end g y -> above (fmax f g) x.
Proof.
  intros L U. unfold fmax. pose proof (upper_above _ _ L) as B. destruct (gt f g) eqn:E; [exact B|].
  destruct L as [->|[F L]].
  - destruct U as [->|[G _]]; [discriminate|]. destruct g; discriminate.
  - destruct U as [->|[G _]]; [destruct f; discriminate|]. split; [intros K; rewrite K in G; discriminate|]. intros _.
    generalize (proj2 (gt_finite f g F G)). rewrite E. intros K. destruct (Rle_or_lt (val f) (val g)) as [M|M]; [lra|].
    discriminate (K M).
Qed.

(** Beyond an end or not. *)
Lemma end_or_beyond k t q : lower_end k q -> lower_end k t \/ (finite k /\ t < val k).
Proof.
  intros [->|[F _]]; [left; now left|]. destruct (Rle_or_lt (val k) t); [left; right; now split|right; now split].
Qed.
Lemma end_or_beyond_up k t q : upper_end k q -> upper_end k t \/ (finite k /\ val k < t).
Proof.
  intros [->|[F _]]; [left; now left|]. destruct (Rle_or_lt t (val k)); [left; right; now split|right; now split].
Qed.

Lemma nearer_square t z q : t <= z <= q \/ q <= z <= t -> (z - t) * (z - t) <= (q - t) * (q - t).
Proof. intros [H|H]; apply Rminus_le; [assert (0 <= (q - z) * (q + z - 2 * t)) by (apply Rmult_le_pos; lra); lra|].
  assert (0 <= (z - q) * (2 * t - q - z)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** The place of [k0,k1] that is nearest to t; it is in the interval of the code. *)
Lemma far_q_contains c k0 k1 t q : lower_end (lo c) t -> upper_end (hi c) t -> lower_end k0 q -> upper_end k1 q ->
  exists z, contains (far_q c k0 k1) z /\ (z - t) * (z - t) <= (q - t) * (q - t).
Proof.
  intros C0 C1 K0 K1. unfold far_q, contains. cbn [lo hi].
  destruct (end_or_beyond k0 t q K0) as [L|[F0 L]].
  - destruct (end_or_beyond_up k1 t q K1) as [U|[F1 U]].
    + exists t. split; [|apply nearer_square; lra]. split.
      * apply below_max; [now apply lower_below|now apply below_min with q].
      * apply above_min; [now apply upper_above|now apply above_max with q].
    + exists (val k1). destruct K1 as [E|[_ K1]]; [rewrite E in F1; discriminate|]. split; [|apply nearer_square; lra].
      split.
      * apply below_max; [apply lower_below; destruct K0 as [K0|[F K0]]; [now left|right; split; [exact F|lra]]|].
        destruct (cases (fmin (lo c) k1)) as [F|[F|[F|F]]].
        -- split; [intros E; rewrite E in F; discriminate|]. intros _. revert F. unfold fmin.
           destruct (lt (lo c) k1) eqn:E; [|intros _; lra]. intros F. apply lt_finite in E; [lra|exact F|exact F1].
        -- split; [intros E; rewrite E in F; discriminate|]. intros G. destruct (fmin (lo c) k1); discriminate.
        -- exfalso. revert F. unfold fmin. destruct (lt (lo c) k1) eqn:E; intros F; [|rewrite F in F1; discriminate].
           destruct C0 as [C0|[C0 _]]; rewrite F in C0; discriminate.
        -- rewrite F. split; discriminate.
      * apply above_min; [split; [intros E; rewrite E in F1; discriminate|intros _; lra]|].
        apply above_max with q; [|exact K0]. destruct C1 as [C1|[F C1]]; [now left|right; split; [exact F|lra]].
  - exists (val k0). destruct K0 as [E|[_ K0]]; [rewrite E in F0; discriminate|]. split; [|apply nearer_square; lra].
    split.
    + apply below_max; [split; [intros E; rewrite E in F0; discriminate|intros _; lra]|].
      apply below_min with q; [|exact K1]. destruct C0 as [C0|[F C0]]; [now left|right; split; [exact F|lra]].
    + apply above_min; [apply upper_above; destruct K1 as [K1|[F K1]]; [now left|right; split; [exact F|lra]]|].
      destruct (cases (fmax (hi c) k0)) as [F|[F|[F|F]]].
      * split; [intros E; rewrite E in F; discriminate|]. intros _. revert F. unfold fmax.
        destruct (gt (hi c) k0) eqn:E; [|intros _; lra]. intros F. apply gt_finite in E; [lra|exact F|exact F0].
      * split; [intros E; rewrite E in F; discriminate|]. intros G. destruct (fmax (hi c) k0); discriminate.
      * rewrite F. split; discriminate.
      * exfalso. revert F. unfold fmax. destruct (gt (hi c) k0) eqn:E; intros F; [|rewrite F in F0; discriminate].
        destruct C1 as [C1|[C1 _]]; rewrite F in C1; discriminate.
Qed.

(** Twice a double is exact or infinite; an infinite end makes the difference unknown. *)
Lemma twice_val f : finite (lit c_far_two * f)%D -> finite f /\ val (lit c_far_two * f)%D = 2 * val f.
Proof.
  intros F. destruct (fmul_inv _ _ F) as (_ & Ff & E). split; [exact Ff|]. rewrite E.
  rewrite (proj2 (lit_correct c_far_two eq_refl)). replace (cval c_far_two * val f) with (val f * bpow radix2 1)
    by (unfold cval, fst, snd; rewrite Rmult_1_l; apply Rmult_comm).
  rewrite rnd_id; [change (bpow radix2 1) with 2; ring|]. apply mult_bpow_pos_exact_FLT; [apply val_format|lia].
Qed.

Lemma less_twice_contains a c x t : contains a x -> lower_end (lo c) t -> upper_end (hi c) t ->
  contains (iv_sub a (far_twice c)) (x - 2 * t).
Proof.
  intros [[_ A1] [_ A2]] C0 C1. split; (split; [apply down_not_inf || apply up_not_ninf|]); simpl; intros F.
  - destruct (fsub_inv _ _ (down_finite _ F)) as (F1 & F2 & E). apply down_below; [exact F|]. rewrite E. apply rnd_le.
    specialize (A1 F1). destruct (twice_val _ F2) as [F3 V]. rewrite V.
    destruct C1 as [C1|[_ C1]]; [rewrite C1 in F3; discriminate|lra].
  - destruct (fsub_inv _ _ (up_finite _ F)) as (F1 & F2 & E). apply up_above; [exact F|]. rewrite E. apply rnd_le.
    specialize (A2 F1). destruct (twice_val _ F2) as [F3 V]. rewrite V.
    destruct C0 as [C0|[_ C0]]; [rewrite C0 in F3; discriminate|lra].
Qed.

Lemma far_low_below c q z s t : contains q z -> finite s -> lower_end (lo c) t -> upper_end (hi c) t ->
  below (far_low q (far_twice c) s) ((z - t) * (z - t) - (val s - t) * (val s - t)).
Proof.
  intros Q F C0 C1. assert (P : contains (iv_point s) (val s)).
  { split; (split; [intros E; cbn [iv_point lo hi] in E; rewrite E in F; discriminate|intros _; cbn [iv_point lo hi];
    lra]). }
  pose proof (iv_mul_contains _ _ _ _ (iv_sub_contains _ _ _ _ Q P)
    (less_twice_contains _ c _ t (iv_add_contains _ _ _ _ Q P) C0 C1)) as [H _].
  unfold far_low. replace ((z - t) * (z - t) - (val s - t) * (val s - t)) with ((z - val s) * (z + val s - 2 * t)) by
    ring.
  exact H.
Qed.

Lemma span4_low p q r s : lo (span4 p q r s) <> inf /\ (finite (lo (span4 p q r s)) -> finite p).
Proof.
  unfold span4. destruct (is_finite 53 1024 (p + q + r + s)%D) eqn:F; cbn [negb lo].
  - split; [apply down_not_inf|]. intros _. destruct (fadd_inv _ _ F) as (F1 & _). destruct (fadd_inv _ _ F1) as (F2 &
    _).
    now destruct (fadd_inv _ _ F2) as (Fp & _).
  - split; [|]; discriminate.
Qed.

Lemma far_low_finite q twice s : finite (far_low q twice s) -> finite s.
Proof.
  intros F. apply span4_low in F. destruct (fmul_inv _ _ F) as (G & _). unfold iv_sub in G. cbn [lo hi iv_point] in G.
  now destruct (fsub_inv _ _ (down_finite _ G)) as (_ & K & _).
Qed.

Lemma far_low_not_inf q twice s : far_low q twice s <> inf.
Proof. apply span4_low. Qed.

Theorem farther_along_correct c s0 s1 k0 k1 t p q : lower_end (lo c) t -> upper_end (hi c) t ->
  lower_end s0 p -> upper_end s1 p -> lower_end k0 q -> upper_end k1 q -> finite (farther_along c s0 s1 k0 k1) ->
  val (farther_along c s0 s1 k0 k1) <= (q - t) * (q - t) - (p - t) * (p - t).
Proof.
  intros C0 C1 S0 S1 K0 K1. destruct (far_q_contains c k0 k1 t q C0 C1 K0 K1) as [z [Q Z]].
  unfold farther_along. cbv zeta. set (l0 := far_low (far_q c k0 k1) (far_twice c) s0).
  set (l1 := far_low (far_q c k0 k1) (far_twice c) s1).
  pose proof (far_low_not_inf (far_q c k0 k1) (far_twice c) s0) as N0. pose proof (far_low_not_inf (far_q c k0 k1)
    (far_twice c) s1) as N1.
  fold l0 in N0. fold l1 in N1.
  assert (Both : finite l0 -> finite l1 -> forall v, v <= val l0 -> v <= val l1 -> v <= (q - t) * (q - t) - (p - t) *
    (p - t)).
  { intros F0 F1 v V0 V1. pose proof (far_low_finite _ _ _ F0) as G0. pose proof (far_low_finite _ _ _ F1) as G1.
    destruct (far_low_below c _ z s0 t Q G0 C0 C1) as [_ B0]. destruct (far_low_below c _ z s1 t Q G1 C0 C1) as [_ B1].
    specialize (B0 F0). specialize (B1 F1). fold l0 in B0. fold l1 in B1.
    destruct S0 as [E|[_ S0]]; [rewrite E in G0; discriminate|]. destruct S1 as [E|[_ S1]]; [rewrite E in G1;
      discriminate|].
    destruct (Rle_or_lt t p); [assert ((p - t) * (p - t) <= (val s1 - t) * (val s1 - t)) by nra; lra|].
    assert ((p - t) * (p - t) <= (val s0 - t) * (val s0 - t)) by (apply nearer_square; lra). lra. }
  clearbody l0 l1. destruct (lt l0 l1) eqn:E.
  - intros F0. destruct (cases l1) as [F1|[F1|[F1|F1]]].
    + apply lt_finite in E; [|exact F0|exact F1]. apply (Both F0 F1); [apply Rle_refl|now apply Rlt_le].
    + destruct l0; destruct l1; discriminate.
    + contradiction.
    + rewrite F1 in E. destruct l0; discriminate.
  - destruct (le l1 l0) eqn:E'; [|discriminate]. intros F1. destruct (cases l0) as [F0|[F0|[F0|F0]]].
    + apply le_finite in E'; [|exact F1|exact F0]. apply (Both F0 F1); [exact E'|apply Rle_refl].
    + destruct l0; destruct l1; discriminate.
    + contradiction.
    + rewrite F0 in E'. destruct l1; discriminate.
Qed.

(** Every place of k is farther from every place of c than every place of s. *)
Definition in_box (b : bbox) (x y : R) : Prop :=
  lower_end (e0 b) x /\ upper_end (e1 b) x /\ lower_end (e2 b) y /\ upper_end (e3 b) y.

Theorem is_farther_correct c s k tx ty px py qx qy : is_farther c s k = true -> in_box c tx ty -> in_box s px py ->
  in_box k qx qy ->
  (px - tx) * (px - tx) + (py - ty) * (py - ty) < (qx - tx) * (qx - tx) + (qy - ty) * (qy - ty).
Proof.
  unfold is_farther. cbv zeta. intros G (C0 & C1 & C2 & C3) (S0 & S1 & S2 & S3) (K0 & K1 & K2 & K3).
  set (x := farther_along _ (e0 s) _ _ _) in *. set (y := farther_along _ (e2 s) _ _ _) in *.
  destruct zero_lit as [Fz Vz]. destruct (cases (down (x + y)%D)) as [F|[F|[F|F]]].
  - apply gt_finite in G; [|exact F|exact Fz]. rewrite Vz in G.
    destruct (fadd_inv _ _ (down_finite _ F)) as (Fx & Fy & E).
    pose proof (farther_along_correct {| lo := e0 c; hi := e1 c |} _ _ _ _ tx px qx C0 C1 S0 S1 K0 K1 Fx) as X.
    pose proof (farther_along_correct {| lo := e2 c; hi := e3 c |} _ _ _ _ ty py qy C2 C3 S2 S3 K2 K3 Fy) as Y.
    fold x in X. fold y in Y. assert (D : val (down (x + y)%D) <= val x + val y) by (apply down_below; [exact F|rewrite
      E; lra]).
    lra.
  - destruct (down (x + y)%D); destruct (lit c_zero); discriminate.
  - now apply down_not_inf in F.
  - rewrite F in G. destruct (lit c_zero); discriminate.
Qed.
