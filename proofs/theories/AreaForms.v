(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Twice the area of the hull of two rectangles without a subtraction of products, as dyd_filter_partial_edge_area2 has it: the
   four forms, and that one of them fits a and b or b and a. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Distance Cells AreaHull.
Open Scope R_scope.

(* One axis: widths, how far the ends are apart, and on which sides b sticks out of a. *)
Record axis : Type := Axis { wa : R; wb : R; low : R; high : R; b_low : bool; b_high : bool }.
Definition below (s t : R) : bool := if Rlt_dec s t then true else false.
Definition axis_of (a0 a1 b0 b1 : R) : axis :=
  Axis (a1 - a0) (b1 - b0) (if below b0 a0 then a0 - b0 else b0 - a0) (if below a1 b1 then b1 - a1 else a1 - b1)
       (below b0 a0) (below a1 b1).
Definition axis_x (A B : rect) : axis := axis_of (xlo A) (xhi A) (xlo B) (xhi B).
Definition axis_y (A B : rect) : axis := axis_of (ylo A) (yhi A) (ylo B) (yhi B).
Definition sides (x : axis) : nat := (Nat.b2n (b_low x) + Nat.b2n (b_high x))%nat.

Definition area2_one (x y : axis) : R :=
  let p := if b_low x then low x else high x in wa x * wa y + wa x * wa y + p * (wa y + wb y).
Definition area2_corner (x y : axis) : R :=
  let p := if b_low x then low x else high x in
  let r := if b_low x then high x else low x in
  let tall := wa y + (if b_low y then low y else high y) in
  wa x * tall + p * wb y + (wb x * tall + r * wa y).
Definition area2_cross (x y : axis) : R := wb x * (wa y + wb y) + wa x * (low y + high y).

Definition area2_form (x y : axis) : R :=
  if (sides x + sides y =? 0)%nat then wa x * wa y + wa x * wa y
  else if ((sides x =? 1) && (sides y =? 1))%nat%bool then area2_corner x y
  else if (sides x + sides y =? 1)%nat then (if (sides x =? 0)%nat then area2_one y x else area2_one x y)
  else (if (sides x =? 0)%nat then area2_cross y x else area2_cross x y).

Ltac settle := repeat match goal with
  | |- context [Rmax ?a ?b] => first [rewrite (Rmax_right a b) by nra | rewrite (Rmax_left a b) by nra]
  | |- context [Rmin ?a ?b] => first [rewrite (Rmin_left a b) by nra | rewrite (Rmin_right a b) by nra] end.

Theorem form_correct A B : (sides (axis_x A B) + sides (axis_y A B) <= 2)%nat ->
  area2_form (axis_x A B) (axis_y A B) = hull_area2 A B.
Proof.
  pose proof (x_ordered A). pose proof (y_ordered A). pose proof (x_ordered B). pose proof (y_ordered B).
  unfold axis_x, axis_y, axis_of, area2_form, sides, below, hull_area2, legs_ll, legs_lr, legs_ul, legs_ur.
  destruct (Rlt_dec (xlo B) (xlo A)) as [L | L]; destruct (Rlt_dec (xhi A) (xhi B)) as [R | R];
    destruct (Rlt_dec (ylo B) (ylo A)) as [D | D]; destruct (Rlt_dec (yhi A) (yhi B)) as [U | U];
    try apply Rnot_lt_le in L; try apply Rnot_lt_le in R; try apply Rnot_lt_le in D; try apply Rnot_lt_le in U;
    simpl; intros K; try (exfalso; lia); clear K; unfold area2_one, area2_corner, area2_cross; simpl; settle; ring.
Qed.

Lemma hull_area2_sym A B : hull_area2 A B = hull_area2 B A.
Proof.
  unfold hull_area2, legs_ll, legs_lr, legs_ul, legs_ur.
  rewrite !(Rmax_comm (xhi B)), !(Rmax_comm (yhi B)), !(Rmin_comm (xlo B)), !(Rmin_comm (ylo B)).
  replace ((xlo A - xlo B) * (ylo A - ylo B)) with ((xlo B - xlo A) * (ylo B - ylo A)) by ring.
  replace ((xhi A - xhi B) * (ylo A - ylo B)) with ((xhi B - xhi A) * (ylo B - ylo A)) by ring.
  replace ((xlo A - xlo B) * (yhi A - yhi B)) with ((xlo B - xlo A) * (yhi B - yhi A)) by ring.
  replace ((xhi A - xhi B) * (yhi A - yhi B)) with ((xhi B - xhi A) * (yhi B - yhi A)) by ring. reflexivity.
Qed.

(* The code takes b and a where b sticks out on more than two sides. *)
Theorem form_fits A B : (2 < sides (axis_x A B) + sides (axis_y A B))%nat ->
  (sides (axis_x B A) + sides (axis_y B A) <= 2)%nat /\ area2_form (axis_x B A) (axis_y B A) = hull_area2 A B.
Proof.
  intros K. assert (S : (sides (axis_x B A) + sides (axis_y B A) <= 2)%nat).
  { revert K. unfold axis_x, axis_y, axis_of, sides, below. simpl.
    repeat match goal with |- context [Rlt_dec ?a ?b] => destruct (Rlt_dec a b) end; simpl; intros K;
      solve [lia | exfalso; lra]. }
  split; [exact S |]. rewrite hull_area2_sym. now apply form_correct.
Qed.

(* The bound of T shrinks with the rectangles: sides of at most w in a box of at most d make hulls of at most 3 w d. *)
Definition fits (w d : R) (x : axis) : Prop := 0 <= wa x <= w /\ 0 <= wb x <= w /\ wa x <= d /\ wb x <= d /\
  0 <= low x <= d /\ 0 <= high x <= d.

Lemma form_small w d x y : fits w d x -> fits w d y -> area2_form x y <= 6 * (w * d).
Proof.
  intros [X1 [X2 [X3 [X4 [X5 X6]]]]] [Y1 [Y2 [Y3 [Y4 [Y5 Y6]]]]].
  assert (P : forall s t, 0 <= s <= w -> 0 <= t <= d -> 0 <= s * t <= w * d)
    by (intros; split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
  pose proof (P (wa x) (wa y)). pose proof (P (wa x) (low y)). pose proof (P (wa x) (high y)).
  pose proof (P (wb x) (wa y)). pose proof (P (wb x) (wb y)). pose proof (P (wb x) (low y)). pose proof (P (wb x) (high y)).
  pose proof (P (wa y) (low x)). pose proof (P (wa y) (high x)). pose proof (P (wb y) (low x)). pose proof (P (wb y) (high x)).
  pose proof (P (wb y) (wa x)).
  unfold area2_form, area2_one, area2_corner, area2_cross.
  repeat match goal with |- context [if ?c then _ else _] => destruct c end; lra.
Qed.

Lemma axis_fits w d m n a0 a1 b0 b1 : a0 <= a1 -> b0 <= b1 -> a1 - a0 <= w -> b1 - b0 <= w ->
  m <= a0 -> m <= b0 -> a1 <= n -> b1 <= n -> n - m <= d -> fits w d (axis_of a0 a1 b0 b1).
Proof.
  intros. unfold fits, axis_of, below. simpl. destruct (Rlt_dec b0 a0); destruct (Rlt_dec a1 b1); lra.
Qed.

Theorem hull_area_small A B w d : xhi A - xlo A <= w -> yhi A - ylo A <= w -> xhi B - xlo B <= w -> yhi B - ylo B <= w ->
  xhi (box A B) - xlo (box A B) <= d -> yhi (box A B) - ylo (box A B) <= d -> hull_area A B <= 3 * (w * d).
Proof.
  intros W1 W2 W3 W4 D1 D2. cbn [box xlo xhi ylo yhi] in D1, D2.
  pose proof (x_ordered A). pose proof (y_ordered A). pose proof (x_ordered B). pose proof (y_ordered B).
  pose proof (Rmin_l (xlo A) (xlo B)). pose proof (Rmin_r (xlo A) (xlo B)).
  pose proof (Rmax_l (xhi A) (xhi B)). pose proof (Rmax_r (xhi A) (xhi B)).
  pose proof (Rmin_l (ylo A) (ylo B)). pose proof (Rmin_r (ylo A) (ylo B)).
  pose proof (Rmax_l (yhi A) (yhi B)). pose proof (Rmax_r (yhi A) (yhi B)).
  assert (E : hull_area2 A B = area2_form (axis_x A B) (axis_y A B) \/ hull_area2 A B = area2_form (axis_x B A) (axis_y B A)).
  { destruct (le_lt_dec (sides (axis_x A B) + sides (axis_y A B)) 2) as [S | S]; [left | right]; symmetry;
      [now apply form_correct | now apply form_fits]. }
  unfold hull_area. assert (hull_area2 A B <= 6 * (w * d)); [| lra].
  destruct E as [-> | ->]; apply form_small; unfold axis_x, axis_y;
    solve [apply (axis_fits _ _ (Rmin (xlo A) (xlo B)) (Rmax (xhi A) (xhi B))); assumption
          | apply (axis_fits _ _ (Rmin (ylo A) (ylo B)) (Rmax (yhi A) (yhi B))); assumption].
Qed.

(* So it comes below every e > 0 when sites stay within a box of width d and their sides shrink. *)
Theorem area_shrinks B pairs w d : (forall i j, In (i, j) pairs ->
    xhi (B i) - xlo (B i) <= w /\ yhi (B i) - ylo (B i) <= w /\ xhi (B j) - xlo (B j) <= w /\ yhi (B j) - ylo (B j) <= w /\
    xhi (box (B i) (B j)) - xlo (box (B i) (B j)) <= d /\ yhi (box (B i) (B j)) - ylo (box (B i) (B j)) <= d) ->
  hull_areas B pairs <= INR (length pairs) * (3 * (w * d)).
Proof.
  induction pairs as [| [i j] pairs IH]; intros H; [simpl; lra |].
  change (length ((i, j) :: pairs)) with (S (length pairs)). rewrite S_INR. cbn [hull_areas].
  destruct (H i j) as [H1 [H2 [H3 [H4 [H5 H6]]]]]; [now left |].
  pose proof (hull_area_small (B i) (B j) w d H1 H2 H3 H4 H5 H6). assert (hull_areas B pairs <= INR (length pairs) * (3 * (w * d))).
  { apply IH. intros k l I. apply H. now right. }
  lra.
Qed.
