(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Hints for the extracted checker, in addition to the certificate: the unit of its integers, triangles, and the fans
   around sites. Nothing proves this file, and nothing has to: the checker rejects wrong hints, or ignores them. *)
module Integers = Z
open Checker
module Z = Integers

(* The least common denominator of all numbers, and the greatest negative exponent. *)
let unit_of sites edges chains =
  let add (d, e) n = ((if Z.equal n.den Z.one then d else Z.lcm d n.den), Z.max e (Z.neg n.expo)) in
  let of_site u s = add (add (add (add u s.left) s.right) s.low) s.high in
  let of_edge u e = add (add u e.at_x) e.at_y in
  let of_point u (x, y) = add (add u x) y in
  let of_chain u c = List.fold_left (fun u (_, p) -> of_point u p) (of_point (of_point u c.first_way) c.last_way) c.links in
  List.fold_left of_chain (List.fold_left of_edge (List.fold_left of_site (Z.one, Z.zero) sites) edges) chains

(* The neighbours of every site, counterclockwise around its lower left corner. *)
let rotation boxes edges =
  let near = Hashtbl.create 1000 in
  let add a b = Hashtbl.replace near a (b :: Option.value ~default:[] (Hashtbl.find_opt near a)) in
  List.iter (fun e -> let i = Z.to_int e.from and j = Z.to_int e.to0 in add i j; add j i) edges;
  let right a b = Z.lt a.x0 b.x0 || (Z.equal a.x0 b.x0 && Z.lt a.y0 b.y0) in
  let compare_around a b c =
    match (right a b, right a c) with true, false -> -1 | false, true -> 1 | _ -> -Z.sign (turn a b c)
  in
  let box = Hashtbl.find boxes in
  let sorted a l =
    let a = box a in
    Array.of_list (List.map snd (List.sort (fun (b, _) (c, _) -> compare_around a b c) (List.map (fun k -> (box k, k)) l)))
  in
  Hashtbl.fold (fun a l found -> (a, sorted a l) :: found) near []

(* Round each site: where two neighbours that follow one another are neighbours, a triangle; a site without a gap, or with
   one, gives a fan. *)
let triangles_and_fans boxes edges =
  let by_name = Hashtbl.create 1000 and is_edge = Hashtbl.create 1000 in
  List.iter (fun b -> Hashtbl.replace by_name (Z.to_int b.box_name) b) boxes;
  List.iter (fun e -> Hashtbl.replace is_edge (Z.to_int e.from, Z.to_int e.to0) ()) edges;
  let box = Hashtbl.find by_name in
  let closes a i j = Hashtbl.mem is_edge (min i j, max i j) && Z.sign (turn (box a) (box i) (box j)) > 0 in
  let triangles = ref [] and fans = ref [] in
  let around (a, near) =
    let n = Array.length near in
    let after k = near.((k + 1) mod n) in
    let closed = Array.mapi (fun k i -> closes a i (after k)) near in
    let gaps = List.filter (fun k -> not closed.(k)) (List.init n Fun.id) in
    let triangle k i =
      let j = after k in
      if a < i && a < j && closed.(k) then
        triangles := { ta = Z.of_int a; tb = Z.of_int i; tc = Z.of_int j } :: !triangles
    in
    let fan first whole =
      let spokes = List.init n (fun k -> Z.of_int near.((first + k) mod n)) in
      fans := { centre = Z.of_int a; spokes; whole } :: !fans
    in
    Array.iteri triangle near;
    match gaps with [] -> fan 0 true | [ k ] -> fan (k + 1) false | _ -> ()
  in
  List.iter around (rotation by_name edges);
  (!triangles, !fans)
