(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [CRIT-1] Every circle through the origin that meets two features is computed by solve_circle, unless it is one of
    infinitely many close by. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Dyadel Require Import Surd Circles.
Open Scope R_scope.

(** Other solutions in every neighbourhood. *)
Definition isolated (P : R -> R -> Prop) (x y : R) : Prop :=
  exists eps, 0 < eps /\ forall x' y', P x' y' -> Rabs (x' - x) < eps -> Rabs (y' - y) < eps -> x' = x /\ y' = y.

Lemma isolated_swap P x y : isolated P x y -> isolated (fun y x => P x y) y x.
Proof. intros (e & E & H). exists e; split; [exact E|]. intros y' x' Q Y X. destruct (H x' y' Q X Y); now split. Qed.

Lemma isolated_iff P Q x y : (forall x y, P x y <-> Q x y) -> isolated P x y -> isolated Q x y.
Proof. intros I (e & E & H). exists e; split; [exact E|]. intros x' y' q. apply H. now apply I. Qed.

(** On a line of solutions, and on a parabola of them, none is isolated. *)
Lemma line_not_isolated (P : R -> R -> Prop) x y nx ny : nx <> 0 \/ ny <> 0 -> (forall t, P (x + t * nx) (y + t * ny))
  ->
  ~ isolated P x y.
Proof.
  intros N H (e & E & U). set (w := Rabs nx + Rabs ny).
  assert (W : 0 < w).
  { unfold w. generalize (Rabs_pos nx) (Rabs_pos ny). destruct N as [N|N]; apply Rabs_pos_lt in N; lra. }
  set (t := e / (2 * w)). assert (T : 0 < t) by (unfold t; apply Rdiv_lt_0_compat; lra).
  assert (K : t * w = e / 2) by (unfold t; field; lra).
  assert (B : forall n, Rabs n <= w -> Rabs (t * n) < e).
  { intros n Hn. rewrite Rabs_mult, (Rabs_pos_eq t) by lra.
    assert (t * Rabs n <= t * w) by (apply Rmult_le_compat_l; lra). lra. }
  destruct (U _ _ (H t)) as [X Y].
  - replace (x + t * nx - x) with (t * nx) by ring. apply B. unfold w; generalize (Rabs_pos ny); lra.
  - replace (y + t * ny - y) with (t * ny) by ring. apply B. unfold w; generalize (Rabs_pos nx); lra.
  - destruct N as [N|N]; apply N; apply Rmult_eq_reg_l with t; lra.
Qed.

Lemma parabola_not_isolated (P : R -> R -> Prop) l u v : l <> 0 -> line_eq l u v ->
  (forall u v, line_eq l u v -> P u v) -> ~ isolated P u v.
Proof.
  intros L S H (e & E & U).
  assert (AL : 0 < Rabs l) by now apply Rabs_pos_lt.
  set (w := 2 * Rabs v + 1). assert (V : 0 <= Rabs v) by apply Rabs_pos. assert (W : 0 < w) by (unfold w; lra).
  set (q := e * Rabs l / w). assert (Q : 0 < q) by (unfold q; apply Rdiv_lt_0_compat;
    [now apply Rmult_lt_0_compat|exact W]).
  set (t := Rmin 1 (Rmin (e / 2) q)).
  assert (T : 0 < t) by (unfold t; repeat apply Rmin_pos; lra).
  assert (T1 : t <= 1) by apply Rmin_l.
  assert (T2 : t <= e / 2) by (unfold t; apply Rle_trans with (1 := Rmin_r _ _); apply Rmin_l).
  assert (T3 : t <= q) by (unfold t; apply Rle_trans with (1 := Rmin_r _ _); apply Rmin_r).
  assert (K : t * w <= e * Rabs l).
  { apply Rle_trans with (q * w); [apply Rmult_le_compat_r; lra|]. unfold q; right; field; lra. }
  assert (D : u - (2 * v * t + t * t) / (2 * l) - u = - ((2 * v * t + t * t) * / (2 * l))) by (field; exact L).
  destruct (U (u - (2 * v * t + t * t) / (2 * l)) (v + t)) as [_ X].
  - apply H. unfold line_eq in *.
    replace (2 * l * (u - (2 * v * t + t * t) / (2 * l))) with (2 * l * u - (2 * v * t + t * t)) by (field; exact L).
    lra.
  - rewrite D, Rabs_Ropp, Rabs_mult, Rabs_inv. rewrite Rabs_mult, (Rabs_pos_eq 2) by lra.
    assert (B : Rabs (2 * v * t + t * t) <= t * w).
    { apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult, (Rabs_pos_eq 2), (Rabs_pos_eq t) by lra.
      assert (t * t <= t * 1) by (apply Rmult_le_compat_l; lra). unfold w; lra. }
    apply Rmult_lt_reg_r with (2 * Rabs l); [lra|]. rewrite Rmult_assoc, Rinv_l by lra. 
    assert (0 < e * Rabs l) by now apply Rmult_lt_0_compat. lra.
  - replace (v + t - v) with t by ring. rewrite Rabs_pos_eq; lra.
  - lra.
Qed.

Lemma axis_not_isolated (P : R -> R -> Prop) u v : line_eq 0 u v -> (forall u v, line_eq 0 u v -> P u v) -> ~ isolated
  P u v.
Proof.
  intros S H. apply (line_not_isolated P u v 1 0); [left; lra|]. intros t. apply H. unfold line_eq in *. lra.
Qed.

Definition both (P Q : R -> R -> Prop) (x y : R) : Prop := P x y /\ Q x y.

Lemma solved_by a b c d v : d <> 0%Z -> IZR d * v = IZR a + IZR b * sqrt (IZR c) ->
  v = (IZR a + IZR b * sqrt (IZR c)) / IZR d.
Proof. intros D <-. field. now apply IZR_neq. Qed.

(** ** Two points *)

Lemma two_points_complete f g x y :
  point_eq (IZR (at0 f)) (IZR (at1 f)) x y -> point_eq (IZR (at0 g)) (IZR (at1 g)) x y ->
  isolated (both (point_eq (IZR (at0 f)) (IZR (at1 f))) (point_eq (IZR (at0 g)) (IZR (at1 g)))) x y ->
  exists k, two_points f g = Some k /\ x = cx k /\ y = cy k.
Proof.
  unfold two_points. cbv zeta. set (fx := at0 f). set (fy := at1 f). set (gx := at0 g). set (gy := at1 g).
  intros F G I. unfold point_eq in F, G.
  assert (Z0 : forall z, z = 0%Z \/ z <> 0%Z) by (intros z; lia).
  destruct (Z.eqb_spec (fx * gy - gx * fy) 0) as [E|E].
  - exfalso. assert (D : IZR fx * IZR gy - IZR gx * IZR fy = 0) by (rewrite <- !mult_IZR, <- minus_IZR, E; reflexivity).
    assert (N : forall nx ny, IZR fx * nx + IZR fy * ny = 0 -> IZR gx * nx + IZR gy * ny = 0 -> nx <> 0 \/ ny <> 0 ->
      False).
    { intros nx ny A B N. revert I. apply (line_not_isolated _ _ _ nx ny N). intros t. unfold both, point_eq. split.
      - replace (2 * IZR fx * (x + t * nx) + 2 * IZR fy * (y + t * ny)) with
          (2 * IZR fx * x + 2 * IZR fy * y + 2 * t * (IZR fx * nx + IZR fy * ny)) by ring. rewrite A, F. ring.
      - replace (2 * IZR gx * (x + t * nx) + 2 * IZR gy * (y + t * ny)) with
          (2 * IZR gx * x + 2 * IZR gy * y + 2 * t * (IZR gx * nx + IZR gy * ny)) by ring. rewrite B, G. ring. }
    destruct (Z0 fx) as [X0|X0]; [destruct (Z0 fy) as [Y0|Y0]|].
    + rewrite X0, Y0 in *. destruct (Z0 gx) as [X1|X1]; [destruct (Z0 gy) as [Y1|Y1]|].
      * rewrite X1, Y1 in *. apply (N 1 0); try lra.
      * apply (N (- IZR gy) (IZR gx)); try ring. left. apply Ropp_neq_0_compat. now apply IZR_neq.
      * apply (N (- IZR gy) (IZR gx)); try ring. right. now apply IZR_neq.
    + apply (N (- IZR fy) (IZR fx)); [ring|lra|]. left. apply Ropp_neq_0_compat. now apply IZR_neq.
    + apply (N (- IZR fy) (IZR fx)); [ring|lra|]. right. now apply IZR_neq.
  - eexists; split; [reflexivity|].
    destruct (rational_correct (norm2 f * gy - norm2 g * fy) (fx * norm2 g - gx * norm2 f) ((fx * gy - gx * fy) * 2))
      as (_ & -> & ->); [lia|].
    assert (D : IZR ((fx * gy - gx * fy) * 2) <> 0) by (apply IZR_neq; lia).
    unfold norm2; fold fx fy gx gy.
    split; apply Rmult_eq_reg_r with (IZR ((fx * gy - gx * fy) * 2)); try exact D; unfold Rdiv;
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r by exact D; repeat rewrite ?mult_IZR, ?minus_IZR, ?plus_IZR;
      rewrite <- F, <- G; ring.
Qed.

(** ** A point and a line, in coordinates across and along the line *)

Lemma point_line_complete point line u v :
  let k := negb (has0 line) in
  let a := if k then at1 point else at0 point in
  let b := if k then at0 point else at1 point in
  let l := if k then at1 line else at0 line in
  point_eq (IZR a) (IZR b) u v -> line_eq (IZR l) u v -> isolated (both (point_eq (IZR a) (IZR b)) (line_eq (IZR l)))
    u v ->
  exists which c, point_and_line point line which = Some c /\ u = (if k then cy c else cx c) /\ v = (if k then cx c
    else cy c).
Proof.
  cbv zeta. unfold point_and_line. cbv zeta.
  set (k := negb (has0 line)). set (a := if k then at1 point else at0 point).
  set (b := if k then at0 point else at1 point).
  set (l := if k then at1 line else at0 line). intros P L I.
  assert (N : norm2 point = (a * a + b * b)%Z) by (unfold norm2, a, b; destruct k; ring).
  rewrite N. clearbody a b l. destruct (Z.eqb_spec a 0) as [A|A].
  - exists false. unfold point_beside_line. cbv zeta. rewrite A in *. unfold point_eq in P.
    destruct (Z.eqb_spec b 0) as [B|B]; [|destruct (Z.eqb_spec l 0) as [E|E]]; cbn [orb].
    + exfalso. rewrite B in I. assert (All : forall u v, line_eq (IZR l) u v -> both (point_eq 0 0) (line_eq (IZR l))
      u v)
        by (intros; split; [unfold point_eq; lra|assumption]).
      destruct (Z.eq_dec l 0) as [E|E].
      * rewrite E in *. revert I. now apply axis_not_isolated.
      * revert I. apply (parabola_not_isolated _ (IZR l)); [now apply IZR_neq|exact L|exact All].
    + exfalso. rewrite E in L. unfold line_eq in L. assert (V : v = 0) by nra. rewrite V in P.
      assert (IZR b <> 0) by now apply IZR_neq. nra.
    + assert (D : IZR (l * 8) <> 0) by (apply IZR_neq; lia). assert (B' : IZR b <> 0) by now apply IZR_neq.
      assert (V : v = IZR b / 2) by (apply Rmult_eq_reg_l with (IZR b); lra).
      assert (L' : IZR l <> 0) by now apply IZR_neq.
      eexists; split; [reflexivity|]. unfold line_eq in L.
      destruct (rational_correct (b * l * 4) (l * l * 4 - b * b) (l * 8)) as (_ & X1 & Y1); [lia|].
      destruct (rational_correct (l * l * 4 - b * b) (b * l * 4) (l * 8)) as (_ & X2 & Y2); [lia|].
      assert (G : u = IZR (l * l * 4 - b * b) / IZR (l * 8) /\ v = IZR (b * l * 4) / IZR (l * 8)).
      { rewrite minus_IZR, !mult_IZR. split.
        - apply Rmult_eq_reg_l with (2 * IZR l); [|lra]. rewrite V in L.
          replace (2 * IZR l * u) with (IZR l * IZR l - IZR b / 2 * (IZR b / 2)) by lra. field; exact L'.
        - rewrite V. field; exact L'. }
      destruct k; rewrite ?X1, ?Y1, ?X2, ?Y2; tauto.
  - assert (A' : IZR a <> 0) by now apply IZR_neq. unfold point_eq in P. unfold line_eq in L.
    set (c := ((a * a + b * b) * ((l - a) * l))%Z).
    assert (S : (0 < a * a + b * b)%Z) by nia.
    set (q := IZR a * v - IZR b * IZR l).
    assert (Q : q * q = IZR c).
    { unfold q, c. repeat rewrite ?mult_IZR, ?minus_IZR, ?plus_IZR.
      assert (Q1 : IZR a * (v * v) - 2 * IZR b * IZR l * v + IZR l * (IZR a * IZR a + IZR b * IZR b) - IZR a * (IZR l
        * IZR l) = 0).
      { rewrite <- P. rewrite <- L. ring. }
      transitivity (IZR a * (IZR a * (v * v) - 2 * IZR b * IZR l * v + IZR l * (IZR a * IZR a + IZR b * IZR b) - IZR a
        * (IZR l * IZR l))
        + (IZR a * IZR a + IZR b * IZR b) * ((IZR l - IZR a) * IZR l)); [ring|]. rewrite Q1. ring. }
    assert (C : (0 <= c)%Z) by (apply le_IZR; rewrite <- Q; apply Rle_0_sqr).
    assert (T : (0 <= (l - a) * l)%Z) by (unfold c in C; nia).
    assert (Y : exists which : bool, (which = true -> ((l - a) * l <> 0)%Z) /\ q = (if which then -1 else 1) * sqrt
      (IZR c)).
    { destruct (Rlt_or_le q 0) as [H|H]; [exists true|exists false]; (split; [|]).
      - intros _ Z. unfold c in Q. rewrite Z, Z.mul_0_r in Q. assert (0 < - q * - q) by (apply Rmult_lt_0_compat;
        lra). lra.
      - replace (IZR c) with (- q * - q) by (rewrite <- Q; ring). rewrite sqrt_square by lra. ring.
      - discriminate.
      - rewrite <- Q, sqrt_square by exact H. ring. }
    destruct Y as (which & W & Y). exists which.
    destruct (Z.ltb_spec ((l - a) * l) 0) as [H|_]; [lia|]. cbn [orb].
    assert (G : (which && ((l - a) * l =? 0)%Z) = false).
    { destruct which; [|reflexivity]. apply Z.eqb_neq. now apply W. }
    rewrite G. eexists; split; [reflexivity|]. rewrite along_cx, along_cy. fold c.
    set (r := sqrt (IZR c)) in *.
    assert (D : IZR (a * a * 2) <> 0) by (apply IZR_neq; nia).
    assert (V : IZR a * v = IZR b * IZR l + (if which then -1 else 1) * r) by (unfold q in Y; lra).
    split; apply Rmult_eq_reg_r with (IZR (a * a * 2)); try exact D; unfold Rdiv;
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r by exact D;
      destruct which; repeat rewrite ?opp_IZR, ?mult_IZR, ?minus_IZR, ?plus_IZR.
    + transitivity (IZR a * (2 * IZR a * u)); [ring|].
      replace (2 * IZR a * u) with (IZR a * IZR a + IZR b * IZR b - 2 * IZR b * v) by lra.
      transitivity ((IZR a * IZR a + IZR b * IZR b) * IZR a - 2 * IZR b * (IZR a * v)); [ring|]. rewrite V; ring.
    + transitivity (IZR a * (2 * IZR a * u)); [ring|].
      replace (2 * IZR a * u) with (IZR a * IZR a + IZR b * IZR b - 2 * IZR b * v) by lra.
      transitivity ((IZR a * IZR a + IZR b * IZR b) * IZR a - 2 * IZR b * (IZR a * v)); [ring|]. rewrite V; ring.
    + transitivity (2 * IZR a * (IZR a * v)); [ring|]. rewrite V; ring.
    + transitivity (2 * IZR a * (IZR a * v)); [ring|]. rewrite V; ring.
Qed.

(** ** Two lines *)

Lemma parallel_complete l m (k : bool) u v : line_eq (IZR l) u v -> line_eq (IZR m) u v ->
  isolated (both (line_eq (IZR l)) (line_eq (IZR m))) u v ->
  exists which c, parallel_lines l m k which = Some c /\ u = (if k then cy c else cx c) /\ v = (if k then cx c else cy
    c).
Proof.
  intros L M I. unfold parallel_lines. cbv zeta. destruct (Z.eqb_spec l m) as [E|E].
  - exfalso. rewrite <- E in I. assert (All : forall u v, line_eq (IZR l) u v -> both (line_eq (IZR l)) (line_eq (IZR
    l)) u v)
      by (intros; now split).
    destruct (Z.eq_dec l 0) as [Z0|Z0].
    + rewrite Z0 in *. revert I. now apply axis_not_isolated.
    + revert I. apply (parabola_not_isolated _ (IZR l)); [now apply IZR_neq|exact L|exact All].
  - unfold line_eq in L, M. assert (N : IZR l - IZR m <> 0) by (rewrite <- minus_IZR; apply IZR_neq; lia).
    assert (U : 2 * u = IZR l + IZR m) by (apply Rmult_eq_reg_l with (IZR l - IZR m); lra).
    assert (Q : v * v = IZR (- (l * m))).
    { rewrite opp_IZR, mult_IZR. replace (v * v) with (IZR l * IZR l - IZR l * (2 * u)) by lra. rewrite U; ring. }
    assert (C : (0 <= - (l * m))%Z) by (apply le_IZR; rewrite <- Q; apply Rle_0_sqr).
    assert (Y : exists which : bool, (which = true -> (- (l * m) <> 0)%Z) /\ v = (if which then -1 else 1) * sqrt (IZR
      (- (l * m)))).
    { destruct (Rlt_or_le v 0) as [H|H]; [exists true|exists false]; (split; [|]).
      - intros _ Z. rewrite Z in Q. assert (0 < - v * - v) by (apply Rmult_lt_0_compat; lra). lra.
      - replace (IZR (- (l * m))) with (- v * - v) by (rewrite <- Q; ring). rewrite sqrt_square by lra. ring.
      - discriminate.
      - rewrite <- Q, sqrt_square by exact H. ring. }
    destruct Y as (which & W & Y). exists which.
    destruct (Z.ltb_spec (- (l * m)) 0) as [H|_]; [lia|]. cbn [orb].
    assert (G : (which && (- (l * m) =? 0)%Z) = false).
    { destruct which; [|reflexivity]. apply Z.eqb_neq. now apply W. }
    rewrite G. eexists; split; [reflexivity|]. rewrite along_cx, along_cy. rewrite plus_IZR. split; [lra|].
    rewrite Y at 1. destruct which; field.
Qed.

Lemma crossing_complete l m u v : line_eq (IZR l) u v -> line_eq (IZR m) v u ->
  exists which, u = cx (crossing_lines l m which) /\ v = cy (crossing_lines l m which).
Proof.
  intros L M. unfold line_eq in L, M.
  (* |u - l| = |v - m| *)
  assert (Z : exists z0 : Z, (z0 = 1 \/ z0 = -1)%Z /\ v - IZR m = IZR z0 * (u - IZR l)).
  { assert (S : (v - IZR m - (u - IZR l)) * (v - IZR m + (u - IZR l)) = 0) by lra.
    apply Rmult_integral in S. destruct S as [S|S]; [exists 1%Z|exists (-1)%Z]; (split; [lia|lra]). }
  destruct Z as (z0 & Z & V).
  assert (zz : IZR z0 * IZR z0 = 1) by (destruct Z as [-> | ->]; lra).
  set (w := u + IZR z0 * IZR m).
  assert (V' : v = IZR m + IZR z0 * (u - IZR l)) by lra.
  assert (W : w * w = IZR (z0 * (l * m) * 2)).
  { rewrite !mult_IZR. rewrite V' in L.
    transitivity (u * u + 2 * u * (IZR z0 * IZR m) + IZR z0 * IZR z0 * (IZR m * IZR m)); [unfold w; ring|].
    assert (L2 : IZR m * IZR m + 2 * IZR z0 * IZR m * (u - IZR l) + IZR z0 * IZR z0 * ((u - IZR l) * (u - IZR l)) + 2
      * IZR l * u = IZR l * IZR l)
      by (rewrite <- L; ring).
    rewrite zz in *. lra. }
  assert (X : v = - (IZR z0 * IZR l) + IZR z0 * w).
  { rewrite V'. unfold w. transitivity (IZR m + IZR z0 * u - IZR z0 * IZR l); [ring|].
    transitivity (- (IZR z0 * IZR l) + (IZR z0 * u + IZR z0 * IZR z0 * IZR m)); [rewrite zz; ring|ring]. }
  unfold crossing_lines, cx, cy. cbn [a0 a1 b0 b1 cc dd].
  destruct (Z.eqb_spec (Z.sgn l * Z.sgn m) 0) as [E|E].
  - assert (lm : (l * m = 0)%Z) by (destruct l; destruct m; simpl in *; lia).
    rewrite lm, Z.mul_0_r in W. simpl in W. assert (W0 : w = 0) by nra.
    exists (z0 =? -1)%Z. destruct Z as [-> | ->]; cbn [Z.eqb]; simpl (-1 =? -1)%Z; cbv iota; rewrite !mult_IZR;
      unfold w in *; split; simpl IZR in *; lra.
  - assert (E1 : (l * m <> 0)%Z) by (destruct l; destruct m; simpl in *; lia).
    assert (C : (0 <= z0 * (l * m) * 2)%Z) by (apply le_IZR; rewrite <- W; apply Rle_0_sqr).
    assert (Zs : (Z.sgn l * Z.sgn m = z0)%Z).
    { rewrite <- Z.sgn_mul. destruct Z as [-> | ->]; [apply Z.sgn_pos|apply Z.sgn_neg]; lia. }
    assert (A : (Z.abs (l * m * 2) = z0 * (l * m) * 2)%Z) by (destruct Z as [-> | ->]; lia).
    rewrite Zs, A. set (r := sqrt (IZR (z0 * (l * m) * 2))).
    assert (Y : exists which : bool, w = (if which then -1 else 1) * r).
    { destruct (Rlt_or_le w 0) as [H|H]; [exists true|exists false]; unfold r.
      - replace (IZR (z0 * (l * m) * 2)) with (- w * - w) by (rewrite <- W; ring). rewrite sqrt_square by lra. ring.
      - rewrite <- W, sqrt_square by exact H. ring. }
    destruct Y as (which & Y). exists which.
    assert (U : u = - (IZR z0 * IZR m) + w) by (unfold w; ring).
    rewrite U, X, Y, !mult_IZR, !opp_IZR. destruct which; simpl IZR; split; field.
Qed.

(** ** The theorem *)

Definition solution (f g : feature) (x y : R) : Prop := meets f x y /\ meets g x y.

Lemma isolated_both (P Q P' Q' : R -> R -> Prop) x y : (forall x y, P x y <-> P' x y) -> (forall x y, Q x y <-> Q' x
  y) ->
  isolated (fun x y => P x y /\ Q x y) x y -> isolated (both P' Q') x y.
Proof. intros A B. apply isolated_iff. intros x' y'. unfold both. rewrite A, B. tauto. Qed.

Lemma isolated_both' (P Q P' Q' : R -> R -> Prop) x y : (forall x y, P x y <-> P' x y) -> (forall x y, Q x y <-> Q' x
  y) ->
  isolated (fun x y => P x y /\ Q x y) x y -> isolated (both Q' P') x y.
Proof. intros A B. apply isolated_iff. intros x' y'. unfold both. rewrite A, B. tauto. Qed.

Lemma point_eq_swap a b x y : point_eq a b x y <-> point_eq b a y x.
Proof. unfold point_eq; split; intros; lra. Qed.

(** [CRIT-1] An isolated circle that meets both features is returned by solve_circle for which = 0 or 1. *)
Theorem solve_complete f g x y : has0 f || has1 f = true -> has0 g || has1 g = true ->
  solution f g x y -> isolated (solution f g) x y -> exists which k, solve f g which = Some k /\ x = cx k /\ y = cy k.
Proof.
  destruct f as [f0 f1 fx fy], g as [g0 g1 gx gy]. unfold solution, solve, meets. simpl has0. simpl has1. simpl at0.
  simpl at1.
  destruct f0, f1, g0, g1; cbn [andb orb]; intros HF HG; try discriminate HF; try discriminate HG; intros [F G] I.
  - apply meets_point in F. apply meets_point in G.
    apply (isolated_both _ _ _ _ _ _ (meets_point _ _) (meets_point _ _)) in I.
    destruct (two_points_complete {| has0 := true; has1 := true; at0 := fx; at1 := fy |}
      {| has0 := true; has1 := true; at0 := gx; at1 := gy |} x y F G I) as (k & K & X). now exists false, k.
  - apply meets_point in F. apply meets_line in G. apply (isolated_both _ _ _ _ _ _ (meets_point _ _) (meets_line _))
    in I.
    exact (point_line_complete {| has0 := true; has1 := true; at0 := fx; at1 := fy |}
      {| has0 := true; has1 := false; at0 := gx; at1 := gy |} x y F G I).
  - apply meets_point in F. apply meets_line' in G.
    apply (isolated_both _ _ _ (fun x y => line_eq (IZR gy) y x) _ _ (meets_point _ _) (meets_line' _)) in I.
    apply isolated_swap in I. apply point_eq_swap in F.
    apply (isolated_iff _ (both (point_eq (IZR fy) (IZR fx)) (line_eq (IZR gy)))) in I;
      [|intros; unfold both; rewrite point_eq_swap; tauto].
    destruct (point_line_complete {| has0 := true; has1 := true; at0 := fx; at1 := fy |}
      {| has0 := false; has1 := true; at0 := gx; at1 := gy |} y x F G I) as (w & k & K & Y & X). now exists w, k.
  - apply meets_line in F. apply meets_point in G. apply (isolated_both' _ _ _ _ _ _ (meets_line _) (meets_point _ _))
    in I.
    exact (point_line_complete {| has0 := true; has1 := true; at0 := gx; at1 := gy |}
      {| has0 := true; has1 := false; at0 := fx; at1 := fy |} x y G F I).
  - apply meets_line in F. apply meets_line in G. apply (isolated_both _ _ _ _ _ _ (meets_line _) (meets_line _)) in I.
    exact (parallel_complete fx gx false x y F G I).
  - apply meets_line in F. apply meets_line' in G. destruct (crossing_complete fx gy x y F G) as (w & X & Y).
    exists w. eexists; split; [reflexivity|now split].
  - apply meets_line' in F. apply meets_point in G.
    apply (isolated_both' _ _ (fun x y => line_eq (IZR fy) y x) _ _ _ (meets_line' _) (meets_point _ _)) in I.
    apply isolated_swap in I. apply point_eq_swap in G.
    apply (isolated_iff _ (both (point_eq (IZR gy) (IZR gx)) (line_eq (IZR fy)))) in I;
      [|intros; unfold both; rewrite point_eq_swap; tauto].
    destruct (point_line_complete {| has0 := true; has1 := true; at0 := gx; at1 := gy |}
      {| has0 := false; has1 := true; at0 := fx; at1 := fy |} y x G F I) as (w & k & K & Y & X). now exists w, k.
  - apply meets_line' in F. apply meets_line in G. destruct (crossing_complete gx fy x y G F) as (w & X & Y).
    exists w. eexists; split; [reflexivity|now split].
  - apply meets_line' in F. apply meets_line' in G.
    apply (isolated_both _ _ (fun x y => line_eq (IZR fy) y x) (fun x y => line_eq (IZR gy) y x) _ _ (meets_line' _)
      (meets_line' _)) in I.
    apply isolated_swap in I.
    destruct (parallel_complete fy gy true y x F G I) as (w & k & K & Y & X). now exists w, k.
Qed.
