(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Which circle, or line, shows a pair to be a tie, and which two sites the pair's segment meets: a hint, as in hints.ml. In a
   polygon of points on an empty circle, those next to one end of a diagonal are on its two sides. *)
module Integers = Z
open Checker
module Z = Integers

let half_turn a b c = Z.sign (turn a b c)

(* Twice the centre of the circle through three points that turn left, as a centre. *)
let circle a b c =
  let square k = Z.add (Z.mul k.x0 k.x0) (Z.mul k.y0 k.y0) in
  let sum f = Z.add (Z.mul (square a) (f b c)) (Z.add (Z.mul (square b) (f c a)) (Z.mul (square c) (f a b))) in
  let w = turn a b c in
  let sx = sum (fun p q -> Z.sub p.y0 q.y0) and sy = sum (fun p q -> Z.sub q.x0 p.x0) in
  { sx; sy; sw = Z.shift_left w 1 }

(* a and b with k to the right of their line, l to the left. *)
let crossing a b k l =
  let across = turn k l a and over = turn k l b and right = Z.neg (turn a b k) and left = turn a b l in
  { about = circle a b l; near_side = k.box_name; far_side = l.box_name; weight_from = Z.neg over; weight_to = across;
    weight_near = left; weight_far = right }

(* k is between a and b: the lines on both sides. *)
let between a b k =
  let dx = Z.sub b.x0 a.x0 and dy = Z.sub b.y0 a.y0 in
  let part p q = Z.add (Z.mul dx (Z.sub q.x0 p.x0)) (Z.mul dy (Z.sub q.y0 p.y0)) in
  let weight_from = part k b and weight_to = part a k in
  let line sx sy =
    { about = { sx; sy; sw = Z.zero }; near_side = k.box_name; far_side = k.box_name; weight_from; weight_to;
      weight_near = Z.add weight_from weight_to; weight_far = Z.zero }
  in
  [ line (Z.neg dy) dx; line dy (Z.neg dx) ]

let is_point b = Z.equal b.x0 b.x1 && Z.equal b.y0 b.y1

(* For a pair of points: the neighbour of the first one that follows the pair's direction, on either side, or is in it. *)
let hint boxes edges =
  let by_name = Hashtbl.create 1000 and near = Hashtbl.create 1000 in
  List.iter (fun b -> if is_point b then Hashtbl.replace by_name (Z.to_int b.box_name) b) boxes;
  let add i j = Option.iter (fun b -> Hashtbl.add near i b) (Hashtbl.find_opt by_name j) in
  List.iter (fun e -> let i = Z.to_int e.from and j = Z.to_int e.to0 in add i j; add j i) edges;
  let ends e = (Hashtbl.find_opt by_name (Z.to_int e.from), Hashtbl.find_opt by_name (Z.to_int e.to0)) in
  fun e ->
    match ends e with
    | Some a, Some b ->
      let around = Hashtbl.find_all near (Z.to_int e.from) in
      let on side = List.filter (fun k -> half_turn a b k = side) around in
      let first side = function
        | [] -> None
        | k :: rest -> Some (List.fold_left (fun best k -> if half_turn a k best = side then k else best) k rest)
      in
      let ahead k =
        let step p q = Z.add (Z.mul (Z.sub b.x0 a.x0) (Z.sub q.x0 p.x0)) (Z.mul (Z.sub b.y0 a.y0) (Z.sub q.y0 p.y0)) in
        Z.sign (step a k) > 0 && Z.sign (step k b) > 0
      in
      List.concat_map (between a b) (List.filter ahead (on 0))
      @ (match (first (-1) (on (-1)), first 1 (on 1)) with Some k, Some l -> [ crossing a b k l ] | _ -> [])
    | _ -> []
