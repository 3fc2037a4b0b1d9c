(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [WIT-NEAR] [WIT-HULL] An edge certified by the triangles next to it, in real numbers: the geometry of
    dyd_filter_edge_near and dyd_filter_hull_edge_near. What their rounding does is not treated here. *)
From Coq Require Import Reals Lra Psatz.
From Flocq Require Import Core.
Open Scope R_scope.

(** Coordinates along the edge: its ends are (-h,0) and (h,0), a centre on the bisector is (0,c), with rho its distance
    to the ends. P = s^2 + t^2 - 2 t c - h^2 is the power of (s,t) for the circle about (0,c) through the ends. *)
Lemma power s t c h rho : rho * rho = h * h + c * c ->
  s * s + (t - c) * (t - c) = s * s + t * t - 2 * t * c - h * h + rho * rho.
Proof. intros H. rewrite H. ring. Qed.

(** The heart of both: if D |t| <= P, no site but the ends is within rho + 2E of (0,c). *)
Lemma nobody_near s t c h rho r D E m : 0 < h -> 0 <= rho -> rho * rho = h * h + c * c -> rho <= r -> h <= r ->
  0 < D -> D <= 2 * r -> 0 <= E -> 0 < m -> m <= 2 * h -> 199 * E <= m -> 2425 / 100 * E * (r * r) < m * h * D ->
  D * Rabs t <= s * s + t * t - 2 * t * c - h * h ->
  m * m <= (s - h) * (s - h) + t * t -> m * m <= (s + h) * (s + h) + t * t ->
  (rho + 2 * E) * (rho + 2 * E) < s * s + (t - c) * (t - c).
Proof.
  intros Ph Prho Erho Hr Hh PD DR PE Pm M2 EM Cond DT Mi Mj.
  destruct (Rlt_or_le ((rho + 2 * E) * (rho + 2 * E)) (s * s + (t - c) * (t - c))) as [L|L]; [exact L|exfalso].
  rewrite (power _ _ _ _ _ Erho) in L. set (P := s * s + t * t - 2 * t * c - h * h) in *.
  assert (Pr : 0 < r) by lra.
  set (W := 4041 / 1000 * E * r).
  assert (PW : P <= W).
  { assert (E * rho <= E * r) by (apply Rmult_le_compat_l; lra).
    assert (E * E <= E * (2 * r / 199)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= E * r) by (apply Rmult_le_pos; lra). unfold W. lra. }
  assert (W0 : 0 <= W) by (unfold W; apply Rmult_le_pos; lra).
  set (T := Rabs t) in *. assert (T0 : 0 <= T) by apply Rabs_pos.
  assert (TT : T * T = t * t) by (unfold T; rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
  assert (C6 : 6 * W * r < m * h * D) by (assert (0 <= E * (r * r)) by (repeat apply Rmult_le_pos; lra); unfold W; lra).
  (* T < r / 3 *)
  assert (DTW : D * T <= W) by lra.
  assert (T3 : T <= r).
  { destruct (Rle_or_lt T r) as [K|K]; [exact K|exfalso].
    assert (D * r <= D * T) by (apply Rmult_le_compat_l; lra).
    assert (D * r * r <= W * r) by (apply Rmult_le_compat_r; lra).
    assert (m * h <= 2 * (r * r)).
    { apply Rle_trans with (2 * h * h); [apply Rmult_le_compat_r; lra|].
      assert (h * h <= r * r) by (apply Rmult_le_compat; lra). lra. }
    assert (m * h * D <= 2 * (r * r) * D) by (apply Rmult_le_compat_r; lra).
    assert (0 < D * (r * r)) by (repeat apply Rmult_lt_0_compat; lra). lra. }
  (* | |s| - h | h <= |s^2 - h^2| <= W + T^2 + 2 T r *)
  set (d := Rabs (Rabs s - h)).
  assert (S2 : Rabs s * Rabs s = s * s) by (rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
  assert (cr : Rabs c <= r).
  { apply Rle_trans with rho; [|exact Hr]. rewrite <- (Rabs_pos_eq rho Prho). apply Rsqr_le_abs_0. unfold Rsqr.
    rewrite Erho. generalize (Rle_0_sqr h); unfold Rsqr; lra. }
  assert (Q : Rabs (s * s - h * h) <= W + T * T + 2 * (T * r)).
  { replace (s * s - h * h) with (P - t * t + 2 * t * c) by (unfold P; ring).
    assert (B : Rabs (2 * t * c) <= 2 * (T * r)).
    { rewrite !Rabs_mult, (Rabs_pos_eq 2) by lra. fold T. rewrite Rmult_assoc.
      apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; assumption. }
    apply Rabs_le_inv in B. assert (0 <= D * T) by (apply Rmult_le_pos; lra). assert (0 <= T * T) by (apply Rle_0_sqr).
    apply Rabs_le. lra. }
  assert (dh : h * d <= Rabs (s * s - h * h)).
  { replace (s * s - h * h) with ((Rabs s + h) * (Rabs s - h)) by (rewrite <- S2; ring).
    rewrite Rabs_mult. fold d. apply Rmult_le_compat_r; [apply Rabs_pos|].
    generalize (Rabs_pos s); intros. rewrite Rabs_pos_eq; lra. }
  assert (K : D * (h * (d + T)) <= 6 * W * r).
  { assert (A1 : D * (h * d) <= D * (W + T * T + 2 * (T * r))) by (apply Rmult_le_compat_l; lra).
    assert (A2 : D * W <= 2 * r * W) by (apply Rmult_le_compat_r; assumption).
    assert (A3 : D * T * T <= W * r) by (apply Rmult_le_compat; try assumption; apply Rmult_le_pos; lra).
    assert (A4 : D * T * r <= W * r) by (apply Rmult_le_compat_r; lra).
    assert (A5 : D * T * h <= W * r) by (apply Rmult_le_compat; try assumption; try lra; apply Rmult_le_pos; lra).
    lra. }
  assert (dT : d + T < m).
  { apply Rmult_lt_reg_l with (D * h); [now apply Rmult_lt_0_compat|]. lra. }
  assert (dd : d * d = (Rabs s - h) * (Rabs s - h)) by (unfold d; rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
  assert (d0 : 0 <= d) by apply Rabs_pos.
  assert (Mm : m * m <= d * d + T * T).
  { rewrite dd, TT. destruct (Rcase_abs s) as [N|N].
    - rewrite (Rabs_left s N). lra.
    - rewrite (Rabs_right s N). lra. }
  assert ((d + T) * (d + T) < m * m) by (apply Rmult_le_0_lt_compat; lra).
  assert (0 <= d * T) by now apply Rmult_le_pos. lra.
Qed.

(** [WIT-NEAR] Two triangles: circles of centres (0,y1), (0,y2) without the site inside; c in the middle. *)
Theorem edge_near_witness s t y1 y2 h rho r E m : let c := (y1 + y2) / 2 in let D := Rabs (y1 - y2) in
  0 < h -> 0 <= rho -> rho * rho = h * h + c * c -> 0 <= r -> h * h + y1 * y1 <= r * r -> h * h + y2 * y2 <= r * r ->
  0 < D -> 0 <= E -> 0 < m -> m <= 2 * h -> 199 * E <= m -> 2425 / 100 * E * (r * r) < m * h * D ->
  h * h + y1 * y1 <= s * s + (t - y1) * (t - y1) -> h * h + y2 * y2 <= s * s + (t - y2) * (t - y2) ->
  m * m <= (s - h) * (s - h) + t * t -> m * m <= (s + h) * (s + h) + t * t ->
  (rho + 2 * E) * (rho + 2 * E) < s * s + (t - c) * (t - c).
Proof.
  intros c D Ph Prho Erho Pr R1 R2 PD PE Pm M2 EM Cond P1 P2 Mi Mj.
  assert (sq : forall x y, 0 <= y -> x * x <= y * y -> Rabs x <= y).
  { intros x y Y H. rewrite <- (Rabs_pos_eq y Y). apply Rsqr_le_abs_0. exact H. }
  assert (S1 : 0 <= y1 * y1) by apply Rle_0_sqr. assert (S2 : 0 <= y2 * y2) by apply Rle_0_sqr.
  assert (A1 : Rabs y1 <= r) by (apply sq; [exact Pr|generalize (Rle_0_sqr h); unfold Rsqr; lra]).
  assert (A2 : Rabs y2 <= r) by (apply sq; [exact Pr|generalize (Rle_0_sqr h); unfold Rsqr; lra]).
  apply (nobody_near s t c h rho r D E m); try assumption.
  - rewrite <- (Rabs_pos_eq rho Prho). apply sq; [exact Pr|]. rewrite Erho. unfold c.
    generalize (Rle_0_sqr (y1 - y2)); unfold Rsqr. lra.
  - rewrite <- (Rabs_pos_eq h) by lra. apply sq; [exact Pr|]. lra.
  - unfold D. apply Rle_trans with (1 := Rabs_triang y1 (- y2)). rewrite Rabs_Ropp. lra.
  - replace (D * Rabs t) with (Rabs ((y1 - y2) * t)) by (unfold D; apply Rabs_mult).
    unfold c. apply Rabs_le. lra.
Qed.

(** [WIT-HULL] A hull edge: all sites on the side t >= 0, one circle of centre (0,y1) and radius r1, c = y1 - r1. *)
Theorem hull_edge_near_witness s t y1 r1 h rho E m : let c := y1 - r1 in
  0 < h -> 0 <= rho -> rho * rho = h * h + c * c -> 0 < r1 -> h * h + y1 * y1 = r1 * r1 ->
  0 <= E -> 0 < m -> m <= 2 * h -> 199 * E <= m -> 4850 / 100 * E * r1 < m * h ->
  0 <= t -> r1 * r1 <= s * s + (t - y1) * (t - y1) ->
  m * m <= (s - h) * (s - h) + t * t -> m * m <= (s + h) * (s + h) + t * t ->
  (rho + 2 * E) * (rho + 2 * E) < s * s + (t - c) * (t - c).
Proof.
  intros c Ph Prho Erho Pr R1 PE Pm M2 EM Cond Pt P1 Mi Mj.
  assert (sq : forall x y, 0 <= y -> x * x <= y * y -> Rabs x <= y).
  { intros x y Y H. rewrite <- (Rabs_pos_eq y Y). apply Rsqr_le_abs_0. exact H. }
  assert (hh : 0 <= h * h) by apply Rle_0_sqr.
  assert (Y : Rabs y1 <= r1) by (apply sq; lra). apply Rabs_le_inv in Y.
  assert (hr : h <= r1).
  { rewrite <- (Rabs_pos_eq h) by lra. apply sq; [lra|]. generalize (Rle_0_sqr y1); unfold Rsqr; lra. }
  apply (nobody_near s t c h rho (2 * r1) (2 * r1) E m); try assumption; try lra.
  - rewrite <- (Rabs_pos_eq rho Prho). apply sq; [lra|]. rewrite Erho. unfold c.
    assert (- y1 * r1 <= r1 * r1) by (apply Rmult_le_compat_r; lra). lra.
  - replace (2425 / 100 * E * (2 * r1 * (2 * r1))) with (4850 / 100 * E * r1 * (2 * r1)) by field.
    apply Rmult_lt_compat_r; lra.
  - rewrite (Rabs_pos_eq t Pt). unfold c. lra.
Qed.
