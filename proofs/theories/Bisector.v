(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Where the farthest point of a rectangle is as far as the nearest point of another one, on its right: the graph of a
   concave function [BIS-1]. *)
From Coq Require Import Reals Lra Lia Psatz List Classical.
From Dyadel Require Import Plane Distance.
Open Scope R_scope.

(* ---- what changes at most n times along a line ---- *)

(* Both hold at y and y', or neither, when none of the places is from y to y'. *)
Definition changes (n : nat) (P : R -> Prop) : Prop := exists l, (length l <= n)%nat /\
  forall y y', y <= y' -> (forall b, In b l -> ~ y <= b <= y') -> (P y <-> P y').

Lemma changes_and n m P Q : changes n P -> changes m Q -> changes (n + m) (fun y => P y /\ Q y).
Proof.
  intros [l [Ll Hl]] [k [Lk Hk]]. exists (l ++ k). split; [rewrite app_length; lia |]. intros y y' L Off.
  rewrite (Hl y y' L), (Hk y y' L); [reflexivity | |]; intros b I; apply Off, in_or_app; auto.
Qed.

Lemma changes_never n (P : R -> Prop) : (forall y, P y) \/ (forall y, ~ P y) -> changes n P.
Proof. intros H. exists nil. split; [simpl; lia |]. intros y y' _ _. destruct H as [H | H]; split; intros; auto;
  elim (H y); auto; elim (H y'); auto. Qed.

Lemma changes_not n P : changes n P -> changes n (fun y => ~ P y).
Proof. intros [l [L H]]. exists l. split; [exact L |]. intros y y' Y Off. specialize (H y y' Y Off). tauto. Qed.

(* A property that lasts from its first place onwards changes once. *)
Lemma changes_up (P : R -> Prop) : (forall y y', y < y' -> P y -> P y') -> changes 1 P.
Proof.
  intros Up. destruct (classic (exists y, P y)) as [[a A] | No]; [| apply changes_never; right; intros y Y; apply No;
    now exists y].
  destruct (classic (exists y, ~ P y)) as [[z Z] | All];
    [| apply changes_never; left; intros y; apply NNPP; intros Y; apply All; now exists y].
  destruct (completeness (fun y => ~ P y)) as [b [Ub Least]].
  - exists a. intros y Y. apply Rnot_lt_le. intros L. now apply Y, (Up a).
  - now exists z.
  - exists (b :: nil). split; [simpl; lia |]. intros y y' L Off. specialize (Off b (or_introl eq_refl)).
    split; intros Q; [destruct (Rle_lt_or_eq_dec _ _ L) as [K | <-]; [now apply (Up y) | exact Q] |].
    apply NNPP. intros N. apply Off. split; [now apply Ub |]. apply Least. intros x X. apply Rnot_lt_le. intros K.
      now apply X, (Up y').
Qed.

Lemma changes_down (P : R -> Prop) : (forall y y', y < y' -> P y' -> P y) -> changes 1 P.
Proof.
  intros D. destruct (changes_not 1 (fun y => ~ P y)) as [l [L H]].
  - apply changes_up. intros y y' Y N Q. now apply N, (D y y').
  - exists l. split; [exact L |]. intros y y' Y Off. specialize (H y y' Y Off). tauto.
Qed.

(* A property that holds between any two places at which it holds changes twice. *)
Lemma changes_between (P : R -> Prop) : (forall y z y', y <= z <= y' -> P y -> P y' -> P z) -> changes 2 P.
Proof.
  intros B. destruct (changes_and 1 1 (fun y => exists z, z <= y /\ P z) (fun y => exists z, y <= z /\ P z)) as [l [L
    H]].
  - apply changes_up. intros y y' Y [z [Z Q]]. exists z. split; [lra | exact Q].
  - apply changes_down. intros y y' Y [z [Z Q]]. exists z. split; [lra | exact Q].
  - assert (E : forall y, P y <-> (exists z, z <= y /\ P z) /\ (exists z, y <= z /\ P z)).
    { intros y. split; [intros Q; split; exists y; split; auto; lra |]. intros [[u [Lu U]] [v [Lv V]]].
      apply (B u y v); auto. }
    exists l. split; [exact L |]. intros y y' Y Off. rewrite !E. now apply H.
Qed.

Section Bisector.
Variables X Y : rect.
Variable apart : xhi X < xlo Y.

(* dl_X^2 - ds_Y^2 at (x,y): negative where X is surely nearer. *)
Definition lead (x y : R) : R := dl (x, y) X * dl (x, y) X - ds (x, y) Y * ds (x, y) Y.

Lemma lead_sign x y : (lead x y < 0 <-> dl (x, y) X < ds (x, y) Y) /\ (lead x y <= 0 <-> dl (x, y) X <= ds (x, y) Y) /\
  (lead x y = 0 <-> dl (x, y) X = ds (x, y) Y).
Proof.
  unfold lead. pose proof (dl_nonneg (x, y) X). pose proof (ds_nonneg (x, y) Y).
  repeat split; intros; try nra.
Qed.

(* From c to c' it changes by at least as much as for two points of the rectangles. *)
Lemma lead_change x y x' y' : exists s q, inside s X /\ inside q Y /\
  2 * ((x' - x) * (fst q - fst s) + (y' - y) * (snd q - snd s)) <= lead x' y' - lead x y.
Proof.
  exists (farthest (x, y) X), (nearest (x, y) Y). split; [apply farthest_inside |]. split; [apply nearest_inside |].
  unfold lead. pose proof (le_dl (x', y') X _ (farthest_inside (x, y) X)) as D.
  pose proof (ds_le (x', y') Y _ (nearest_inside (x, y) Y)) as E.
  assert (D2 : dist2 (x', y') (farthest (x, y) X) <= dl (x', y') X * dl (x', y') X)
    by (rewrite <- dist_sq; pose proof (dist_nonneg (x', y') (farthest (x, y) X)); nra).
  assert (E2 : ds (x', y') Y * ds (x', y') Y <= dist2 (x', y') (nearest (x, y) Y))
    by (rewrite <- dist_sq; pose proof (ds_nonneg (x', y') Y); nra).
  assert (D1 : dl (x, y) X * dl (x, y) X = dist2 (x, y) (farthest (x, y) X)) by apply dist_sq.
  assert (E1 : ds (x, y) Y * ds (x, y) Y = dist2 (x, y) (nearest (x, y) Y)) by apply dist_sq.
  unfold dist2 in *. cbn [fst snd] in *. lra.
Qed.

Definition width : R := xlo Y - xhi X.

Lemma lead_grows x x' y : x <= x' -> 2 * width * (x' - x) <= lead x' y - lead x y.
Proof.
  intros L. destruct (lead_change x y x' y) as (s & q & [[_ S] _] & [[Q _] _] & H). unfold width.
  assert ((xlo Y - xhi X) * (x' - x) <= (fst q - fst s) * (x' - x)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma row_dist s t y : dist (s, y) (t, y) = Rabs (s - t).
Proof.
  unfold dist, dist2. cbn [fst snd]. replace (_ + _) with (Rsqr (s - t)) by (unfold Rsqr; ring). apply sqrt_Rsqr_abs.
Qed.

Lemma lead_continuous y : continuity (fun x => lead x y).
Proof.
  assert (C : forall g : point -> R, (forall a b, g a <= dist a b + g b) -> continuity (fun x => g (x, y) * g (x, y))).
  { intros g G. assert (Cg : continuity (fun x => g (x, y))).
    { apply (lipschitz_continuous 1). intros s t. pose proof (G (s, y) (t, y)) as H. rewrite row_dist in H. lra. }
    exact (continuity_mult _ _ Cg Cg). }
  exact (continuity_minus _ _ (C (fun c => dl c X) (fun a b => dl_move a b X)) (C (fun c => ds c Y) (fun a b =>
    ds_move a b Y))).
Qed.

Definition bisector_root (y : R) : { x : R | lead x y = 0 }.
Proof.
  set (k := Rabs (lead 0 y) / (2 * width)). assert (G : 0 < 2 * width) by (unfold width; lra).
  assert (E : 2 * width * k = Rabs (lead 0 y)) by (unfold k; field; lra).
  assert (K : 0 <= k) by (unfold k; apply Rle_mult_inv_pos; [apply Rabs_pos | exact G]).
  pose proof (lead_grows (- k) 0 y ltac:(lra)) as L. pose proof (lead_grows 0 k y K) as R.
  pose proof (Rle_abs (lead 0 y)). pose proof (Rle_abs (- lead 0 y)) as Ab. rewrite Rabs_Ropp in Ab.
  destruct (IVT_cor (fun x => lead x y) (- k) k (lead_continuous y)) as [x [_ Z]]; [lra | | now exists x].
  assert (lead (- k) y <= 0) by lra. assert (0 <= lead k y) by lra. nra.
Defined.

Definition bisector (y : R) : R := proj1_sig (bisector_root y).

Lemma bisector_zero y : lead (bisector y) y = 0.
Proof. exact (proj2_sig (bisector_root y)). Qed.

(* On the left of the graph X is surely nearer, on the right it is not; on the graph both are as far. *)
Theorem bisector_graph x y : (dl (x, y) X < ds (x, y) Y <-> x < bisector y) /\
  (dl (x, y) X = ds (x, y) Y <-> x = bisector y).
Proof.
  destruct (lead_sign x y) as (Neg & _ & Zero). rewrite <- Neg, <- Zero. pose proof (bisector_zero y) as Z.
  assert (W : 0 < 2 * width) by (unfold width; lra).
  assert (Up : forall a b, a < b -> lead a y < lead b y).
  { intros a b L. pose proof (lead_grows a b y ltac:(lra)). assert (0 < 2 * width * (b - a)) by (apply
    Rmult_lt_0_compat; lra). lra. }
  destruct (Rtotal_order x (bisector y)) as [L | [-> | L]].
  - pose proof (Up _ _ L). split; split; intros; lra.
  - split; split; intros; lra.
  - pose proof (Up _ _ L). split; split; intros; lra.
Qed.

Theorem bisector_concave y1 y2 t : 0 <= t <= 1 ->
  (1 - t) * bisector y1 + t * bisector y2 <= bisector ((1 - t) * y1 + t * y2).
Proof.
  intros T. apply Rnot_lt_le. intros L.
  assert (W : dl (mix t (bisector y1, y1) (bisector y2, y2)) X <= ds (mix t (bisector y1, y1) (bisector y2, y2)) Y).
  { apply nearer_convex_weak; [exact T | |].
    - apply Rle_trans with (dl (bisector y1, y1) X); [apply le_dl, farthest_inside |].
      rewrite (proj2 (proj2 (bisector_graph (bisector y1) y1)) eq_refl). apply ds_le, nearest_inside.
    - apply Rle_trans with (dl (bisector y2, y2) X); [apply le_dl, farthest_inside |].
      rewrite (proj2 (proj2 (bisector_graph (bisector y2) y2)) eq_refl). apply ds_le, nearest_inside. }
  unfold mix in W. cbn [fst snd] in W. destruct (bisector_graph ((1 - t) * bisector y1 + t * bisector y2)
    ((1 - t) * y1 + t * y2)) as [Lt Eq].
  destruct (Rle_lt_or_eq_dec _ _ W) as [Q | Q]; [apply Lt in Q | apply Eq in Q]; lra.
Qed.

(* Where the rectangles overlap in height, the graph stays on the left of Y. *)
Theorem bisector_left y : ylo X <= yhi Y -> ylo Y <= yhi X -> bisector y < xlo Y.
Proof.
  intros A C. apply Rnot_le_lt. intros L. pose proof (x_ordered X) as Ox. pose proof (y_ordered X) as Oy.
  pose proof (x_ordered Y) as Px. pose proof (y_ordered Y) as Py.
  assert (Ge : dl (xlo Y, y) X <= ds (xlo Y, y) Y).
  { destruct (bisector_graph (xlo Y) y) as [Lt Eq]. destruct (Rle_lt_or_eq_dec _ _ L) as [Q | Q];
    [apply Lt in Q | apply Eq in Q]; lra. }
  (* the point of Y that is level with (xlo Y, y), or the end of its side, against a point of X *)
  assert (Beat : forall v h, ylo Y <= v <= yhi Y -> ylo X <= h <= yhi X -> (y - v) * (y - v) <= (y - h) * (y - h) ->
    False).
  { intros v h V H Q. pose proof (ds_le (xlo Y, y) Y (xlo Y, v) ltac:(unfold inside; cbn [fst snd]; lra)) as D.
    pose proof (le_dl (xlo Y, y) X (xhi X, h) ltac:(unfold inside; cbn [fst snd]; lra)) as F.
    assert (G : dist (xlo Y, y) (xlo Y, v) < dist (xlo Y, y) (xhi X, h)).
    { apply dist_lt. unfold dist2. cbn [fst snd]. assert (0 < (xlo Y - xhi X) * (xlo Y - xhi X)) by nra. lra. }
    lra. }
  destruct (Rle_dec y (yhi Y)) as [U | U].
  - destruct (Rle_dec (ylo Y) y) as [V | V].
    + apply (Beat y (ylo X)); [lra | lra |]. pose proof (Rle_0_sqr (y - ylo X)) as S. unfold Rsqr in S. lra.
    + apply (Beat (ylo Y) (yhi X)); [lra | lra | nra].
  - apply (Beat (yhi Y) (ylo X)); [lra | lra | nra].
Qed.

(* Where X is above Y, the graph rises; where it is below, it falls. *)
Lemma bisector_moves y d : (forall s q, inside s X -> inside q Y -> d * (snd q - snd s) < 0) -> bisector y < bisector
  (y + d).
Proof.
  intros H. apply bisector_graph, lead_sign.
  destruct (lead_change (bisector y) (y + d) (bisector y) y) as (s & q & S & Q & E). rewrite bisector_zero in E.
  specialize (H s q S Q). lra.
Qed.

Theorem bisector_rises y y' : yhi Y < ylo X -> y < y' -> bisector y < bisector y'.
Proof.
  intros A L. replace y' with (y + (y' - y)) by ring. apply bisector_moves. intros s q [_ S] [_ Q].
  assert (0 < (y' - y) * (snd s - snd q)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Theorem bisector_falls y y' : yhi X < ylo Y -> y < y' -> bisector y' < bisector y.
Proof.
  intros A L. replace y with (y' + (y - y')) by ring. apply bisector_moves. intros s q [_ S] [_ Q].
  assert (0 < (y' - y) * (snd q - snd s)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* ---- corners and features along the graph ---- *)

(* From which side the far corner of X is, along one axis; the closest feature of Y lies before, level, or behind. *)
Definition beyond_middle (lo hi t : R) : Prop := hi - t <= t - lo.
Definition same_features (y y' : R) : Prop :=
  farthest (bisector y, y) X = farthest (bisector y', y') X /\
  (bisector y < xlo Y <-> bisector y' < xlo Y) /\ (xhi Y < bisector y <-> xhi Y < bisector y') /\
  (y < ylo Y <-> y' < ylo Y) /\ (yhi Y < y <-> yhi Y < y').

Lemma far_same lo hi t t' : (beyond_middle lo hi t <-> beyond_middle lo hi t') -> far_end lo hi t = far_end lo hi t'.
Proof. unfold beyond_middle, far_end. intros H. destruct (Rle_dec (hi - t) (t - lo)), (Rle_dec (hi - t') (t' - lo));
  tauto. Qed.

Lemma along_x : exists a b c, (a + b + c <= 3)%nat /\ changes a (fun y => beyond_middle (xlo X) (xhi X) (bisector y)) /\
  changes b (fun y => bisector y < xlo Y) /\ changes c (fun y => xhi Y < bisector y).
Proof.
  destruct (Rlt_dec (yhi Y) (ylo X)) as [A | A]; [| destruct (Rlt_dec (yhi X) (ylo Y)) as [D | D]].
  - exists 1%nat, 1%nat, 1%nat. split; [lia |]. split; [| split].
    + apply changes_up. intros y y' L Q. pose proof (bisector_rises y y' A L). unfold beyond_middle in *. lra.
    + apply changes_down. intros y y' L Q. pose proof (bisector_rises y y' A L). lra.
    + apply changes_up. intros y y' L Q. pose proof (bisector_rises y y' A L). lra.
  - exists 1%nat, 1%nat, 1%nat. split; [lia |]. split; [| split].
    + apply changes_down. intros y y' L Q. pose proof (bisector_falls y y' D L). unfold beyond_middle in *. lra.
    + apply changes_up. intros y y' L Q. pose proof (bisector_falls y y' D L). lra.
    + apply changes_down. intros y y' L Q. pose proof (bisector_falls y y' D L). lra.
  - exists 2%nat, 0%nat, 0%nat. split; [lia |].
    assert (Left : forall y, bisector y < xlo Y) by (intros y; apply bisector_left; lra). split; [| split].
    + apply changes_between. intros y z y' [L R] Q Q'. destruct (Req_dec y y') as [E | E]; [replace z with y by lra;
      exact Q |].
      set (t := (z - y) / (y' - y)). assert (Ez : z = (1 - t) * y + t * y') by (unfold t; field; lra).
      assert (T : 0 <= t <= 1).
      { unfold t. split; [apply Rle_mult_inv_pos; lra |]. apply (Rmult_le_reg_r (y' - y)); [lra |].
        replace ((z - y) / (y' - y) * (y' - y)) with (z - y) by (field; lra). lra. }
      pose proof (bisector_concave y y' t T) as C. rewrite <- Ez in C. unfold beyond_middle in *. nra.
    + apply changes_never. now left.
    + apply changes_never. right. intros y Q. pose proof (Left y). pose proof (x_ordered Y). lra.
Qed.

(* The far corner of X or the closest feature of Y changes at most six times along the graph. *)
Theorem six_changes : exists l, (length l <= 6)%nat /\
  forall y y', y <= y' -> (forall b, In b l -> ~ y <= b <= y') -> same_features y y'.
Proof.
  destruct along_x as (a & b & c & Le & (l1 & L1 & H1) & (l2 & L2 & H2) & (l3 & L3 & H3)).
  destruct (changes_up (fun y => beyond_middle (ylo X) (yhi X) y)) as (l4 & L4 & H4);
    [intros y y' L Q; unfold beyond_middle in *; lra |].
  destruct (changes_down (fun y => y < ylo Y)) as (l5 & L5 & H5); [intros y y' L Q; lra |].
  destruct (changes_up (fun y => yhi Y < y)) as (l6 & L6 & H6); [intros y y' L Q; lra |].
  exists (l1 ++ l2 ++ l3 ++ l4 ++ l5 ++ l6). split; [rewrite !app_length; lia |]. intros y y' L Off.
  specialize (H1 y y' L). specialize (H2 y y' L). specialize (H3 y y' L). specialize (H4 y y' L).
    specialize (H5 y y' L).
  specialize (H6 y y' L). unfold same_features, farthest. cbn [fst snd].
  split; [f_equal; apply far_same; [apply H1 | apply H4] | split; [apply H2 | split; [apply H3 | split;
    [apply H5 | apply H6]]]];
    intros x I; apply Off; rewrite !in_app_iff; tauto.
Qed.
End Bisector.
