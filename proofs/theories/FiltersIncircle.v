(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [FLT-INC] In-circle determinants in doubles: rounding errors, and what moving the points changes. The theorems about
    the C functions are in FiltersIncircleAt.v and FiltersIncircleNear.v. *)
From Coq Require Import ZArith Reals Lia Lra Psatz.
From Flocq Require Import Core.
From Dyadel Require Import FiltersBase FiltersError FiltersConst.
Open Scope R_scope.

(** The determinant of three vectors: sum of |a|^2 (b x c), cyclic. *)
Definition det3 (ax ay bx by_ cx cy : R) : R :=
  (ax * ax + ay * ay) * (bx * cy - by_ * cx) + (bx * bx + by_ * by_) * (cx * ay - cy * ax)
  + (cx * cx + cy * cy) * (ax * by_ - ay * bx).
(** Positive iff p lies inside the circle through a, b, c, for a, b, c counter-clockwise. *)
Definition incircle (ax ay bx by_ cx cy px py : R) : R :=
  det3 (ax - px) (ay - py) (bx - px) (by_ - py) (cx - px) (cy - py).

(** ** The determinant as the C code computes it, in doubles *)

(* C src/skeleton/mesh_filter.h dyd_see
  double x = a.x - p.x, y = a.y - p.y;
  return (dyd_seen){x, y, x * x + y * y};
*)
(* C src/skeleton/mesh_filter.h dyd_seen_cross
  return a.x * b.y - a.y * b.x;
*)
(** The parts of d: see dyd_filter_incircle_at. *)
Definition lift (x y : double) : double := (x * x + y * y)%D.
Definition cross (bx by_ cx cy : double) : double := (bx * cy - by_ * cx)%D.
Definition term (ax ay bx by_ cx cy : double) : double := (lift ax ay * cross bx by_ cx cy)%D.

Definition Lift (x y : R) : R := x * x + y * y.
Definition Mcross (bx by_ cx cy : R) : R := Rabs bx * Rabs cy + Rabs by_ * Rabs cx.

Lemma Lift_pos x y : 0 <= Lift x y.
Proof. unfold Lift; nra. Qed.
Lemma Mcross_pos bx by_ cx cy : 0 <= Mcross bx by_ cx cy.
Proof. unfold Mcross; apply Rplus_le_le_0_compat; apply Rmult_le_pos; apply Rabs_pos. Qed.
Lemma Mcross_le bx by_ cx cy : Mcross bx by_ cx cy <= (Lift bx by_ + Lift cx cy) / 2.
Proof.
  unfold Mcross, Lift.
  assert (S : forall x, x * x = Rabs x * Rabs x) by (intros x; rewrite <- Rabs_mult, Rabs_pos_eq; nra).
  rewrite (S bx), (S by_), (S cx), (S cy).
  generalize (Rle_0_sqr (Rabs bx - Rabs cy)) (Rle_0_sqr (Rabs by_ - Rabs cx)); unfold Rsqr; lra.
Qed.

(** x is a double that approximates X as a difference of two doubles does. *)
Definition diff (x : double) (X : R) : Prop := app 1 0 (Rabs X) (val x) X.

Definition h4 : R := (1 + u) * (eta + eta).

Lemma eta_small : 10 ^ 30 * eta <= 1.
Proof.
  unfold eta. apply Rmult_le_reg_r with (bpow radix2 1075); [apply bpow_gt_0|].
  rewrite Rmult_assoc, <- bpow_plus. change (bpow radix2 (-1075 + 1075)) with 1. rewrite Rmult_1_r, Rmult_1_l.
  apply Rle_trans with (bpow radix2 100); [numerals; lra|apply bpow_le; lia].
Qed.

Lemma eta2 : eta * eta <= eta / 10 ^ 30.
Proof.
  assert (10 ^ 30 * eta * eta <= 1 * eta) by (apply Rmult_le_compat_r; [left; apply eta_pos|exact eta_small]). lra.
Qed.

Lemma lift_app x y X Y : diff x X -> diff y Y -> finite (lift x y) ->
  app 4 h4 (Lift X Y) (val (lift x y)) (Lift X Y).
Proof.
  intros Dx Dy F. unfold lift in *. destruct (fadd_inv _ _ F) as (F1 & F2 & E). rewrite E.
  destruct (fmul_inv _ _ F1) as (_ & _ & E1). destruct (fmul_inv _ _ F2) as (_ & _ & E2). rewrite E1, E2.
  eapply app_weaken with (k := 4%nat) (h := h4); [|lia|lra|].
  - apply app_add; try apply rnd_format; apply (app_mul0 1 1); eassumption.
  - unfold Lift. rewrite <- !Rabs_mult, !Rabs_pos_eq; nra.
Qed.

Lemma cross_app bx by_ cx cy BX BY CX CY : diff bx BX -> diff by_ BY -> diff cx CX -> diff cy CY ->
  finite (cross bx by_ cx cy) -> app 4 h4 (Mcross BX BY CX CY) (val (cross bx by_ cx cy)) (BX * CY - BY * CX).
Proof.
  intros D1 D2 D3 D4 F. unfold cross in *. destruct (fsub_inv _ _ F) as (F1 & F2 & E). rewrite E.
  destruct (fmul_inv _ _ F1) as (_ & _ & E1). destruct (fmul_inv _ _ F2) as (_ & _ & E2). rewrite E1, E2.
  apply app_sub; try apply rnd_format; apply (app_mul0 1 1); assumption.
Qed.

Definition hterm (l m : R) : R := 21 / 10 * eta * (l + m) + 2 * eta.

Lemma hterm_bound l m : 0 <= l -> 0 <= m ->
  (1 + u) * (h4 * ((1 + u) ^ 4 * m) + h4 * ((1 + u) ^ 4 * l) + h4 * h4) + eta <= hterm l m.
Proof.
  intros Pl Pm. unfold hterm, h4. generalize eta_small eta_pos; intros S P.
  pose proof eta2 as E2.
  assert (K : (1 + u) * ((1 + u) * (eta + eta)) * (1 + u) ^ 4 <= 21 / 10 * eta) by (unfold u; lra).
  assert (K' : (1 + u) * ((1 + u) * (eta + eta) * ((1 + u) * (eta + eta))) <= 5 * (eta * eta)).
  { replace ((1 + u) * ((1 + u) * (eta + eta) * ((1 + u) * (eta + eta)))) with (4 * (1 + u) ^ 3 * (eta * eta)) by ring.
    apply Rmult_le_compat_r; [nra|unfold u; lra]. }
  replace ((1 + u) * ((1 + u) * (eta + eta) * ((1 + u) ^ 4 * m) + (1 + u) * (eta + eta) * ((1 + u) ^ 4 * l)
    + (1 + u) * (eta + eta) * ((1 + u) * (eta + eta))) + eta)
    with ((1 + u) * ((1 + u) * (eta + eta)) * (1 + u) ^ 4 * (l + m)
      + (1 + u) * ((1 + u) * (eta + eta) * ((1 + u) * (eta + eta))) + eta) by ring.
  assert ((1 + u) * ((1 + u) * (eta + eta)) * (1 + u) ^ 4 * (l + m) <= 21 / 10 * eta * (l + m))
    by (apply Rmult_le_compat_r; lra).
  lra.
Qed.

Lemma term_app ax ay bx by_ cx cy AX AY BX BY CX CY : diff ax AX -> diff ay AY -> diff bx BX -> diff by_ BY ->
  diff cx CX -> diff cy CY -> finite (lift ax ay) -> finite (cross bx by_ cx cy) ->
  app 9 (hterm (Lift AX AY) (Mcross BX BY CX CY)) (Lift AX AY * Mcross BX BY CX CY)
    (rnd (val (lift ax ay) * val (cross bx by_ cx cy))) (Lift AX AY * (BX * CY - BY * CX)).
Proof.
  intros D1 D2 D3 D4 D5 D6 F1 F2. generalize eta_pos; intros P.
  assert (H4 : 0 <= h4) by (unfold h4, u; lra).
  eapply app_weaken; [apply (app_mul 4 4 h4 h4); [exact H4|exact H4|now apply lift_app|now apply cross_app]|lia| |lra].
  apply hterm_bound; [apply Lift_pos|apply Mcross_pos].
Qed.

Lemma pow9 : (1 + u) ^ 9 - 1 <= 9001 / 1000 * u.
Proof. unfold u; lra. Qed.
Lemma pow11 : (1 + u) ^ 11 - 1 <= 11001 / 1000 * u.
Proof. unfold u; lra. Qed.

(** The sum of the three terms, before and after its last rounding. *)
Lemma sum_app ta tb tc a b c la ma lb mb lc mc : format ta -> format tb -> format tc ->
  0 <= la -> 0 <= ma -> 0 <= lb -> 0 <= mb -> 0 <= lc -> 0 <= mc ->
  app 9 (hterm la ma) (la * ma) ta a -> app 9 (hterm lb mb) (lb * mb) tb b -> app 9 (hterm lc mc) (lc * mc) tc c ->
  Rabs (rnd (rnd (ta + tb) + tc) - (a + b + c)) <=
    11001 / 1000 * u * (la * ma + lb * mb + lc * mc) + 22 / 10 * eta * (la + ma + lb + mb + lc + mc) + 7 * eta.
Proof.
  intros Fa Fb Fc Pla Pma Plb Pmb Plc Pmc A B C. generalize eta_pos; intros P.
  pose proof (app_add _ _ _ _ _ _ _ _ _ Fa Fb A B) as S.
  assert (C' : app 10 (hterm lc mc) (lc * mc) tc c) by (apply app_weaken with (1 := C); [lia|lra|lra]).
  pose proof (app_add _ _ _ _ _ _ _ _ _ (rnd_format _) Fc S C') as T.
  pose proof (app_m_pos _ _ _ _ _ T) as M. destruct T as [_ T]. apply Rle_trans with (1 := T).
  assert (H1 : ((1 + u) ^ 11 - 1) * (la * ma + lb * mb + lc * mc) <= 11001 / 1000 * u * (la * ma + lb * mb + lc * mc))
    by (apply Rmult_le_compat_r; [exact M|exact pow11]).
  unfold hterm.
  assert (E : 0 <= eta * (la + ma) /\ 0 <= eta * (lb + mb) /\ 0 <= eta * (lc + mc))
    by (repeat split; apply Rmult_le_pos; lra).
  unfold u in *. lra.
Qed.

(** ** Moving the points *)

Lemma abs_of_sqr x y : 0 <= y -> x * x <= y * y -> Rabs x <= y.
Proof. intros P H. rewrite <- (Rabs_pos_eq y P). apply Rsqr_le_abs_0. exact H. Qed.

Lemma cross_le bx by_ cx cy s t : 0 <= s -> 0 <= t -> Lift bx by_ <= s * s -> Lift cx cy <= t * t ->
  Rabs (bx * cy - by_ * cx) <= s * t.
Proof.
  intros Ps Pt S T. apply abs_of_sqr; [now apply Rmult_le_pos|].
  apply Rle_trans with (Lift bx by_ * Lift cx cy).
  - unfold Lift. generalize (Rle_0_sqr (bx * cx + by_ * cy)); unfold Rsqr; lra.
  - replace (s * t * (s * t)) with (s * s * (t * t)) by ring.
    apply Rmult_le_compat; try apply Lift_pos; assumption.
Qed.

Lemma dot_le bx by_ cx cy s t : 0 <= s -> 0 <= t -> Lift bx by_ <= s * s -> Lift cx cy <= t * t ->
  Rabs (bx * cx + by_ * cy) <= s * t.
Proof.
  intros Ps Pt S T. replace (bx * cx + by_ * cy) with (bx * cx - by_ * (- cy)) by ring.
  apply cross_le; try assumption. replace (Lift (- cy) cx) with (Lift cx cy) by (unfold Lift; ring). exact T.
Qed.

Lemma sum_le ax ay bx by_ s t : 0 <= s -> 0 <= t -> Lift ax ay <= s * s -> Lift bx by_ <= t * t ->
  Lift (ax + bx) (ay + by_) <= (s + t) * (s + t).
Proof.
  intros Ps Pt S T. pose proof (dot_le ax ay bx by_ s t Ps Pt S T) as D.
  generalize (Rle_abs (ax * bx + ay * by_)). unfold Lift in *. lra.
Qed.

Lemma det3_turn ax ay bx by_ cx cy : det3 ax ay bx by_ cx cy = det3 bx by_ cx cy ax ay.
Proof. unfold det3; ring. Qed.

(** Moving one vector by w. *)
Lemma det3_step ax ay dx dy bx by_ cx cy t w : 0 <= t -> 0 <= w ->
  Lift ax ay <= t * t -> Lift (ax + dx) (ay + dy) <= t * t -> Lift dx dy <= w * w ->
  Lift bx by_ <= t * t -> Lift cx cy <= t * t ->
  Rabs (det3 (ax + dx) (ay + dy) bx by_ cx cy - det3 ax ay bx by_ cx cy) <= 4 * (t * t * t) * w.
Proof.
  intros Pt Pw A A' D B C.
  replace (det3 (ax + dx) (ay + dy) bx by_ cx cy - det3 ax ay bx by_ cx cy) with
    (((ax + (ax + dx)) * dx + (ay + (ay + dy)) * dy) * (bx * cy - by_ * cx)
     + (Lift bx by_ * (cx * dy - cy * dx) + Lift cx cy * (dx * by_ - dy * bx))) by (unfold det3, Lift; ring).
  apply Rle_trans with (1 := Rabs_triang _ _).
  assert (T1 : Rabs (((ax + (ax + dx)) * dx + (ay + (ay + dy)) * dy) * (bx * cy - by_ * cx)) <= (t + t) * w * (t * t)).
  { rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos.
    - apply dot_le; try assumption; [lra|now apply sum_le].
    - now apply cross_le. }
  assert (T2 : Rabs (Lift bx by_ * (cx * dy - cy * dx)) <= t * t * (t * w)).
  { rewrite Rabs_mult, (Rabs_pos_eq (Lift _ _)) by apply Lift_pos.
    apply Rmult_le_compat; [apply Lift_pos|apply Rabs_pos|exact B|now apply cross_le]. }
  assert (T3 : Rabs (Lift cx cy * (dx * by_ - dy * bx)) <= t * t * (w * t)).
  { rewrite Rabs_mult, (Rabs_pos_eq (Lift _ _)) by apply Lift_pos.
    apply Rmult_le_compat; [apply Lift_pos|apply Rabs_pos|exact C|now apply cross_le]. }
  generalize (Rabs_triang (Lift bx by_ * (cx * dy - cy * dx)) (Lift cx cy * (dx * by_ - dy * bx))). lra.
Qed.

(** Moving all three, from vectors of length at most r. *)
Lemma det3_moved ax ay bx by_ cx cy dax day dbx dby dcx dcy r w : 0 <= r -> 0 <= w ->
  Lift ax ay <= r * r -> Lift bx by_ <= r * r -> Lift cx cy <= r * r ->
  Lift dax day <= w * w -> Lift dbx dby <= w * w -> Lift dcx dcy <= w * w ->
  Rabs (det3 (ax + dax) (ay + day) (bx + dbx) (by_ + dby) (cx + dcx) (cy + dcy) - det3 ax ay bx by_ cx cy)
    <= 12 * ((r + w) * (r + w) * (r + w)) * w.
Proof.
  intros Pr Pw A B C DA DB DC. set (t := r + w).
  assert (Pt : 0 <= t) by (unfold t; lra).
  assert (W : forall x, x <= r * r -> x <= t * t) by (intros x H; unfold t; nra).
  pose proof (sum_le _ _ _ _ r w Pr Pw A DA) as A'; pose proof (sum_le _ _ _ _ r w Pr Pw B DB) as B'.
  pose proof (sum_le _ _ _ _ r w Pr Pw C DC) as C'. fold t in A', B', C'.
  apply W in A; apply W in B; apply W in C.
  pose proof (det3_step ax ay dax day bx by_ cx cy t w Pt Pw A A' DA B C) as S1.
  pose proof (det3_step bx by_ dbx dby cx cy (ax + dax) (ay + day) t w Pt Pw B B' DB C A') as S2.
  pose proof (det3_step cx cy dcx dcy (ax + dax) (ay + day) (bx + dbx) (by_ + dby) t w Pt Pw C C' DC A' B') as S3.
  rewrite <- !(det3_turn (ax + dax)) in S2. rewrite !(det3_turn cx), !(det3_turn (cx + dcx)) in S3.
  apply Rabs_le_inv in S1; apply Rabs_le_inv in S2; apply Rabs_le_inv in S3. apply Rabs_le; lra.
Qed.

Lemma incircle_moved ax ay bx by_ cx cy px py ax' ay' bx' by_' cx' cy' px' py' delta r : 0 <= delta -> 0 <= r ->
  Rabs (ax' - ax) <= delta -> Rabs (ay' - ay) <= delta -> Rabs (bx' - bx) <= delta -> Rabs (by_' - by_) <= delta ->
  Rabs (cx' - cx) <= delta -> Rabs (cy' - cy) <= delta -> Rabs (px' - px) <= delta -> Rabs (py' - py) <= delta ->
  Lift (ax - px) (ay - py) <= r * r -> Lift (bx - px) (by_ - py) <= r * r -> Lift (cx - px) (cy - py) <= r * r ->
  let t := r + 283 / 100 * delta in
  Rabs (incircle ax' ay' bx' by_' cx' cy' px' py' - incircle ax ay bx by_ cx cy px py) <= 34 * delta * (t * t * t).
Proof.
  intros Pd Pr H1 H2 H3 H4 H5 H6 H7 H8 A B C t.
  assert (S : forall x x' y y' z z' w w', Rabs (x' - x) <= delta -> Rabs (y' - y) <= delta -> Rabs (z' - z) <= delta ->
    Rabs (w' - w) <= delta -> Lift ((x' - x) - (z' - z)) ((y' - y) - (w' - w)) <=
    283 / 100 * delta * (283 / 100 * delta)).
  { intros x x' y y' z z' w w' X Y Z W. apply Rabs_le_inv in X; apply Rabs_le_inv in Y.
    apply Rabs_le_inv in Z; apply Rabs_le_inv in W. unfold Lift.
    assert (Q : forall q, - (2 * delta) <= q <= 2 * delta -> q * q <= 4 * (delta * delta)) by (intros q Q; nra).
    assert (Q1 := Q (x' - x - (z' - z)) ltac:(lra)). assert (Q2 := Q (y' - y - (w' - w)) ltac:(lra)). nra. }
  assert (Pw : 0 <= 283 / 100 * delta) by lra.
  pose proof (det3_moved _ _ _ _ _ _ _ _ _ _ _ _ r (283 / 100 * delta) Pr Pw A B C
    (S _ _ _ _ _ _ _ _ H1 H2 H7 H8) (S _ _ _ _ _ _ _ _ H3 H4 H7 H8) (S _ _ _ _ _ _ _ _ H5 H6 H7 H8)) as D.
  fold t in D. unfold incircle.
  replace (ax - px + (ax' - ax - (px' - px))) with (ax' - px') in D by ring.
  replace (ay - py + (ay' - ay - (py' - py))) with (ay' - py') in D by ring.
  replace (bx - px + (bx' - bx - (px' - px))) with (bx' - px') in D by ring.
  replace (by_ - py + (by_' - by_ - (py' - py))) with (by_' - py') in D by ring.
  replace (cx - px + (cx' - cx - (px' - px))) with (cx' - px') in D by ring.
  replace (cy - py + (cy' - cy - (py' - py))) with (cy' - py') in D by ring.
  apply Rle_trans with (1 := D).
  assert (0 <= t) by (unfold t; lra).
  assert (0 <= t * t * t) by (repeat apply Rmult_le_pos; assumption).
  assert (0 <= delta * (t * t * t)) by (now apply Rmult_le_pos). lra.
Qed.
