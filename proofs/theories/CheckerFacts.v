(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The twelfth part of the checker of certificates: where points are that a block describes,
  and that some are the same, on
   one line, on one circle. CheckerFactsSound.v says what follows. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerEnclosure CheckerAlgebra CheckerBlock CheckerVanish.
Import ListNotations.
Open Scope Z_scope.

(* The number as written, as a fraction; den > 0. *)
Definition fraction_of (n : number) : Z * Z := (Z.shiftl (man n) (Z.max 0 (expo n)),
  Z.shiftl (den n) (Z.max 0 (- expo n))).

(* A point of two numbers of the block. *)
Record place : Type := Place { at_first : Z; at_second : Z }.
Inductive fact : Type := Same (a b : place) | OnLine (a b : place) (l : list place) | OnCircle (a b c : place) (l :
  list place).

Section Facts.

Variable most u : Z.
Variable st : state.
(* Hints, of any origin: what shows that a polynomial is 0. *)
Variable cofactor_hint : poly -> cofactor.

Let add_q := q_add most (relations st).
Let sub_q := q_sub most (relations st).
Let mul_q := q_mul most (relations st).

Definition is_null_there (x : quotient_of) : bool :=
  is_null x || match x with Some (p, _) => vanishes most u (relations st) (held st) p (cofactor_hint p) | None => false end.

(* ---- a number and a side of a rectangle ---- *)

Definition is_in (x : known) (lo hi : number) : bool :=
  let (a, b) := fraction_of lo in let (c, d) := fraction_of hi in
  (0 <? den lo) && (0 <? den hi) &&
  (match within x with Some (p, q) => (a * u <=? p * b) && (q * d <=? c * u) | None => false end ||
   ((a * d =? c * b) && is_null_there (sub_q (is x) (q_fraction most a b)))).
Definition is_seen_outside (x : known) (lo hi : number) : bool :=
  let (a, b) := fraction_of lo in let (c, d) := fraction_of hi in
  (0 <? den lo) && (0 <? den hi) &&
  match within x with Some (p, q) => (q * b <? a * u) || (c * u <? p * d) | None => false end.

Definition with_number (f : known -> bool) (a : Z) : bool := match Map.find a (numbers st) with Some x => f x | None
  => false end.
Definition place_in (p : place) (s : site) : bool :=
  with_number (fun x => is_in x (left s) (right s)) (at_first p) && with_number (fun x => is_in x (low s) (high s))
    (at_second p).
Definition place_outside (p : place) (s : site) : bool :=
  with_number (fun x => is_seen_outside x (left s) (right s)) (at_first p) ||
  with_number (fun x => is_seen_outside x (low s) (high s)) (at_second p).

(* ---- facts ---- *)

Definition number_at (a : Z) : known := match Map.find a (numbers st) with Some x => x | None => Known None None end.
Definition less (x y : known) : known := Known (sub (within x) (within y)) (sub_q (is x) (is y)).
Definition product_with (x y : known) : known := Known (mul most u (within x) (within y)) (mul_q (is x) (is y)).
Definition sum_with (x y : known) : known := Known (add (within x) (within y)) (add_q (is x) (is y)).
Definition is_zero (x : known) : bool := is_null_there (is x).
Definition is_no_zero (x : known) : bool := negb (sign_of (within x) =? 0).

(* b - a *)
Definition step_x (a b : place) : known := less (number_at (at_first b)) (number_at (at_first a)).
Definition step_y (a b : place) : known := less (number_at (at_second b)) (number_at (at_second a)).
Definition cross (ax ay bx by_ : known) : known := less (product_with ax by_) (product_with ay bx).
(* A square is not negative. *)
Definition square (x : known) : known :=
  Known (mul most u (absolute (within x)) (absolute (within x))) (mul_q (is x) (is x)).
Definition norm (x y : known) : known := sum_with (square x) (square y).

(* For a circle through a, with the steps v, w to b, c: the term that is 0 for the step d to a point on it is
   dx along_x + dy along_y + d^2 (v x w). *)
Record circle_base : Type := Base { along_x : known; along_y : known; area : known }.
Definition base_of (a b c : place) : circle_base :=
  let vx := step_x a b in let vy := step_y a b in let wx := step_x a c in let wy := step_y a c in
  let v2 := norm vx vy in let w2 := norm wx wy in
  Base (less (product_with w2 vy) (product_with v2 wy)) (less (product_with v2 wx) (product_with w2 vx)) (cross vx
    vy wx wy).
Definition off_circle (g : circle_base) (a d : place) : known :=
  let dx := step_x a d in let dy := step_y a d in
  sum_with (sum_with (product_with dx (along_x g)) (product_with dy (along_y g))) (product_with (norm dx dy) (area
    g)).
Definition off_line (a b d : place) : known := cross (step_x a b) (step_y a b) (step_x a d) (step_y a d).

Definition fact_holds (f : fact) : bool :=
  match f with
  | Same a b => is_zero (step_x a b) && is_zero (step_y a b)
  | OnLine a b l => (is_no_zero (step_x a b) || is_no_zero (step_y a b)) && forallb (fun d => is_zero (off_line a b
    d)) l
  | OnCircle a b c l =>
    let g := base_of a b c in is_no_zero (area g) && forallb (fun d => is_zero (off_circle g a d)) l
  end.
Definition fact_fails (f : fact) : bool :=
  match f with
  | Same a b => is_no_zero (step_x a b) || is_no_zero (step_y a b)
  | OnLine a b l => (is_zero (step_x a b) && is_zero (step_y a b)) || existsb (fun d => is_no_zero (off_line a b d)) l
  | OnCircle a b c l => let g := base_of a b c in is_zero (area g) || existsb (fun d => is_no_zero (off_circle g a
    d)) l
  end.

End Facts.
