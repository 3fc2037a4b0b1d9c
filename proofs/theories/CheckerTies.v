(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The sixth part of the checker of certificates: ties, and what an outcome says. CheckerTiesSound.v and
   CheckerOutcomeSound.v say what follows. Circles and crossing pairs are hints of any origin. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerFaces CheckerCover.
Import ListNotations.
Open Scope Z_scope.

(* A circle about a centre (a line, when it is at infinity) through both sites of a pair, with no site inside; and two
   sites, or one, that the pair's segment meets: by weights a point of it is a point between them. *)
Record tie : Type := Tie { about : spot; near_side : Z; far_side : Z; weight_from : Z; weight_to : Z; weight_near : Z;
                           weight_far : Z }.

Definition is_point (b : box) : bool := (x0 b =? x1 b) && (y0 b =? y1 b).

Definition is_centre_of (g : spot) (f : Z) : bool :=
  if 0 <? sw g then 0 <? f else (sw g =? 0) && negb ((sx g =? 0) && (sy g =? 0)).

(* Tests that wherever the points are, both are on one circle (line) with no site inside (beyond). *)
Definition on_empty_circle (t : tree) (g : spot) (a b : box) : bool :=
  let f := Z.max (far g a) (far g b) in
  let off := fun k => f <=? near g k in
  is_centre_of g f && all_in off off t.

Definition square_of (b : box) : Z := x0 b * x0 b + y0 b * y0 b.

(* Four points: does the segment of a and b meet that of k and l, where no circle has a and b inside and both k and l
   outside? *)
Definition are_crossed (h : tie) (a b k l : box) : bool :=
  let u := weight_from h in let v := weight_to h in let s := weight_near h in let t := weight_far h in
  is_point a && is_point b && is_point k && is_point l &&
  (0 <=? s) && (0 <=? t) && (0 <? s + t) && (u + v =? s + t) &&
  (u * x0 a + v * x0 b =? s * x0 k + t * x0 l) && (u * y0 a + v * y0 b =? s * y0 k + t * y0 l) &&
  (s * square_of k + t * square_of l <=? u * square_of a + v * square_of b).

Definition is_other (e : edge) (i : Z) : bool := negb (i =? from e) && negb (i =? to e).

Definition check_tie (m : Map.t box) (t : tree) (e : edge) (h : tie) : bool :=
  is_other e (near_side h) && is_other e (far_side h) &&
  match Map.find (from e) m, Map.find (to e) m, Map.find (near_side h) m, Map.find (far_side h) m with
  | Some a, Some b, Some k, Some l => are_crossed h a b k l && on_empty_circle t (about h) a b
  | _, _, _, _ => false
  end.

(* The pairs that none of their hints shows to be ties; meaningful when `check` accepts. *)
Definition loose_ties (D E : Z) (sites : list site) (hint : edge -> list tie) (pairs : list edge) : list edge :=
  match scaled_sites D E sites with
  | Some boxes =>
    let m := index box_name boxes in let t := build deepest boxes in
    kept (fun e => negb (existsb (check_tie m t e) (hint e))) pairs
  | None => pairs
  end.

(* ---- outcomes ---- *)

(* No bound is written with more bits. *)
Definition enough : Z := 4294967296.

(* Is n at most 2^-m? *)
Definition bound_reaches (m : Z) (n : number) : bool :=
  let k := - (expo n + m) in
  (den n =? 1) && ((man n <=? 0) || ((0 <=? k) && (Z.shiftr (man n - 1) (Z.min k enough) =? 0))).
