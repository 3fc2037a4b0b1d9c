(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Twice the area of the hull of two rectangles without a subtraction of products, as dyd_filter_hull_area2 has it: the
   four forms, and that one of them fits a and b or b and a. *)
From Coq Require Import Reals Lra Lia Psatz.
From Dyadel Require Import Plane Distance AreaHull.
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
