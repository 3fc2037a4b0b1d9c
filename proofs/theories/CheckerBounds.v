(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The third part of the checker of certificates: the bounds of area and Hausdorff distance where the pairs listed are
   all possible ones, legal or open. CheckerBoundsSound.v states their meaning. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker.
Import ListNotations.
Open Scope Z_scope.

(* Twice the area of the hull of two rectangles: twice their bounding box, less the product of the legs at each corner. *)
Definition hull_twice (a b : box) : Z :=
  2 * ((Z.max (x1 a) (x1 b) - Z.min (x0 a) (x0 b)) * (Z.max (y1 a) (y1 b) - Z.min (y0 a) (y0 b)))
  - Z.max 0 (- ((x0 b - x0 a) * (y0 b - y0 a))) - Z.max 0 ((x1 b - x1 a) * (y0 b - y0 a))
  - Z.max 0 ((x0 b - x0 a) * (y1 b - y1 a)) - Z.max 0 (- ((x1 b - x1 a) * (y1 b - y1 a))).

(* Is z, in units of 1 / (D 2^E)^2, at most n? *)
Definition at_most (D E z : Z) (n : number) : bool :=
  let k := expo n + 2 * E in
  (0 <? den n) &&
  (Z.shiftl (z * den n) (Z.max 0 (- k)) <=? Z.shiftl (man n * (D * D)) (Z.max 0 k)).

Fixpoint area_onto (m : Map.t box) (edges : list edge) (before : Z) : option Z :=
  match edges with
  | [] => Some before
  | e :: rest =>
    match Map.find (from e) m, Map.find (to e) m with
    | Some a, Some b => area_onto m rest (before + hull_twice a b)
    | _, _ => None
    end
  end.

Definition area_holds (D E : Z) (sites : list site) (edges : list edge) (bound : number) : bool :=
  match scaled_sites D E sites with
  | Some boxes =>
    match area_onto (index box_name boxes) edges 0 with
    | Some z => at_most D E z (Number (2 * man bound) (expo bound) (den bound))
    | None => false
    end
  | None => false
  end.

Definition diameter2 (b : box) : Z := let u := x1 b - x0 b in let v := y1 b - y0 b in u * u + v * v.

Definition is_within (D E : Z) (m : Map.t box) (bound2 : number) (i : Z) : bool :=
  match Map.find i m with Some b => at_most D E (diameter2 b) bound2 | None => false end.

(* The square of the greatest distance of two points in the boxes. *)
Definition length2 (a b : box) : Z :=
  let u := Z.max (x1 a - x0 b) (x1 b - x0 a) in let v := Z.max (y1 a - y0 b) (y1 b - y0 a) in u * u + v * v.

(* Is sqrt l / 2 + sqrt d at most p / q? *)
Definition roots_fit (l d p q : Z) : bool :=
  let t := 4 * (p * p) - q * q * (l + 4 * d) in (0 <=? t) && (16 * (q * q * (q * q)) * (l * d) <=? t * t).

(* Half the length of a pair that is open, and the greater diameter of its sites. *)
Definition is_near (D E : Z) (m : Map.t box) (bound : number) (e : edge) : bool :=
  match Map.find (from e) m, Map.find (to e) m with
  | Some a, Some b =>
    let k := expo bound + E in
    let p := Z.shiftl (man bound * D) (Z.max 0 k) in let q := Z.shiftl (den bound) (Z.max 0 (- k)) in
    roots_fit (length2 a b) (Z.max (diameter2 a) (diameter2 b)) p q
  | _, _ => false
  end.

Definition hausdorff_holds (D E : Z) (sites : list site) (edges opened : list edge) (bound : number) : bool :=
  match scaled_sites D E sites with
  | Some boxes =>
    let m := index box_name boxes in
    let bound2 := Number (man bound * man bound) (2 * expo bound) (den bound * den bound) in
    (0 <=? man bound) && (0 <? den bound) &&
    forallb (fun e => is_within D E m bound2 (from e) && is_within D E m bound2 (to e)) edges &&
    forallb (is_near D E m bound) opened
  | None => false
  end.
