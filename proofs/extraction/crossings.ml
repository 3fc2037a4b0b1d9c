(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* By which set of points on one circle, or line, a pair is a tie, and which sites show it: hints, as in hints.ml. Sites are
   ordered by the middles of their boxes, along the line or around the circle; those next to the ends do. *)
module Integers = Z
open Checker
module Z = Integers

(* Twice the middle of a box. *)
let middle b = (Z.add b.x0 b.x1, Z.add b.y0 b.y1)

let along (ax, ay) (bx, by) (cx, cy) = Z.add (Z.mul (Z.sub bx ax) (Z.sub cx ax)) (Z.mul (Z.sub by ay) (Z.sub cy ay))
let across (ax, ay) (bx, by) = Z.sub (Z.mul ax by) (Z.mul ay bx)

let on_line l =
  match l with
  | (_, a) :: (_, b) :: _ -> List.sort (fun (_, p) (_, q) -> Z.compare (along a b p) (along a b q)) l
  | _ -> l

(* Counterclockwise, by direction from the mean. *)
let on_circle l =
  let n = Z.of_int (List.length l) in
  let total = List.fold_left (fun (x, y) (_, (a, b)) -> (Z.add x a, Z.add y b)) (Z.zero, Z.zero) l in
  let seen (k, (x, y)) = (k, (Z.sub (Z.mul n x) (fst total), Z.sub (Z.mul n y) (snd total))) in
  let upper (x, y) = Z.sign y > 0 || (Z.sign y = 0 && Z.sign x > 0) in
  let before (_, p) (_, q) =
    match (upper p, upper q) with true, false -> -1 | false, true -> 1 | _ -> Z.sign (across q p)
  in
  List.sort before (List.map seen l)

let hint boxes sets =
  let by_name = Hashtbl.create 1000 and own = Hashtbl.create 1000 in
  List.iter (fun b -> Hashtbl.replace by_name (Z.to_int b.box_name) (middle b)) boxes;
  let order (number, g) =
    let place k = Option.map (fun p -> (k, p)) (Hashtbl.find_opt by_name (Z.to_int k)) in
    let l = List.filter_map place g.site_names in
    let l = match g.says with OnCircle _ -> on_circle l | _ -> on_line l in
    let sites = Array.of_list (List.map fst l) in
    Array.iteri (fun at k -> Hashtbl.add own (Z.to_int k) (number, g, sites, at)) sites
  in
  List.iter order sets;
  let crossing (number, g, sites, s) t =
    let n = Array.length sites in
    let by one other = { by_set = number; one_side = sites.(one mod n); other_side = sites.(other mod n) } in
    match g.says with OnCircle _ -> by (t + 1) (s + 1) | _ -> let between = min s t + 1 in by between between
  in
  fun e ->
    let of_to = Hashtbl.find_all own (Z.to_int e.to0) in
    let shared ((number, _, _, _) as here) =
      List.filter_map (fun (other, _, _, t) -> if Z.equal number other then Some (crossing here t) else None) of_to
    in
    List.concat_map shared (Hashtbl.find_all own (Z.to_int e.from))
