(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* plane.c, boxes.c, near.c and stars.c *)
open Filters
open Harness

let define_signs () =
  define "dyd_filter_orient" 7 (fun a ->
      let x = double a in
      integer (filter_orient (x 0) (x 1) (x 2) (x 3) (x 4) (x 5) (x 6)));
  define "dyd_filter_turn" 2 (fun a -> integer (Plane.answer (double a 1) (double a 0)));
  define "dyd_filter_orient_near" 7 (fun a ->
      let x = double a in
      integer (filter_orient_near (x 0) (x 1) (x 2) (x 3) (x 4) (x 5) (x 6)));
  define "dyd_filter_orient_small" 7 (fun a ->
      let x = double a in
      maybe integer (filter_orient_small (x 0) (x 1) (x 2) (x 3) (x 4) (x 5) (x 6)));
  let incircle name of_points =
    define name 9 (fun a ->
        let x = double a in
        of_points (x 0) (x 1) (x 2) (x 3) (x 4) (x 5) (x 6) (x 7) (x 8))
  in
  let told f d ax ay bx by cx cy px py = integer (f d ax ay bx by cx cy px py) in
  incircle "dyd_filter_incircle_at" (told filter_incircle_at);
  incircle "dyd_filter_incircle_near" (told filter_incircle_near);
  incircle "dyd_filter_incircle_small" (fun d ax ay bx by cx cy px py ->
      maybe integer (filter_incircle_small d ax ay bx by cx cy px py))

(* The theories have these parts of the in-circle test inlined. *)
let define_parts () =
  let parts (ax, ay) (bx, by) (cx, cy) =
    doubles
      [ Plane.lift ax ay; Plane.lift bx by; Plane.lift cx cy; Plane.cross bx by cx cy; Plane.cross cx cy ax ay;
        Plane.cross ax ay bx by ]
  in
  let seen a k p = (fsub (double a k) (double a p), fsub (double a (k + 1)) (double a (p + 1))) in
  define "dyd_see" 4 (fun a ->
      let x, y = seen a 0 2 in
      doubles [ x; y; Plane.lift x y ]);
  define "dyd_seen_cross" 4 (fun a -> bits (Plane.cross (double a 0) (double a 1) (double a 2) (double a 3)));
  define "dyd_incircle_from" 6 (fun a -> parts (point a 0) (point a 2) (point a 4));
  define "dyd_incircle_of" 8 (fun a -> parts (seen a 0 6) (seen a 2 6) (seen a 4 6))

let define_bounds () =
  define "dyd_filter_orient_bound" 3 (fun a -> bits (orient_bound (double a 0) (double a 1) (double a 2)));
  define "dyd_min" 2 (fun a -> bits (Plane.fmin (double a 0) (double a 1)));
  define "dyd_max" 2 (fun a -> bits (fmax (double a 0) (double a 1)));
  define "dyd_lower" 1 (fun a -> bits (lower (double a 0)));
  define "dyd_upper" 1 (fun a -> bits (upper (double a 0)));
  define "dyd_ds2_lower" 8 (fun a -> bits (ds2_lower (box_at a 0) (box_at a 4)));
  define "dyd_dl2_upper" 8 (fun a -> bits (dl2_upper (box_at a 0) (box_at a 4)));
  define "dyd_ds2_upper" 9 (fun a -> bits (ds2_upper (box_at a 0) (box_at a 4) (double a 8)));
  define "dyd_dl2_lower" 9 (fun a -> bits (dl2_lower (box_at a 0) (box_at a 4) (double a 8)))

let define_boxes () =
  define "reach" 6 (fun a -> bits (reach (box_at a 0) (double a 4) (double a 5)));
  define "dyd_box_widen" 8 (fun a -> doubles (box_ends (hull (box_at a 0) (box_at a 4))));
  define "dyd_height_lower" 10 (fun a -> bits (height_lower (box_at a 0) (double a 4) (double a 5) (box_at a 6)));
  (* The number stays as it is where the denominator is 1. *)
  define "dyd_scale_to_user" 5 (fun a ->
      let l = double a 4 in
      let outward k = if k mod 2 = 1 then user_upper else user_lower in
      let to_user k = if a.(4) = "3ff0000000000000" then double a k else outward k (double a k) l in
      doubles (List.map to_user [ 0; 1; 2; 3 ]));
  define "dyd_direction_d" 2 (fun a -> pair (direction_d (whole a 0) (whole a 1)))

let define_near () =
  define "dyd_square_distance" 4 (fun a -> bits (square_distance (double a 0) (double a 1) (double a 2) (double a 3)));
  define "dyd_filter_edge_near" 10 (fun a ->
      let x = double a in
      yes (filter_edge_near (x 0) (x 1) (x 2) (x 3) (x 4) (x 5) (x 6) (x 7) (x 8) (x 9)));
  define "dyd_filter_hull_edge_near" 8 (fun a ->
      let x = double a in
      yes (filter_hull_edge_near (x 0) (x 1) (x 2) (x 3) (x 4) (x 5) (x 6) (x 7)));
  define "double_turn" 6 (fun a ->
      let o = point a 0 and p = point a 2 and q = point a 4 in
      doubles [ Area.turn o p q; Area.turn_error o p q ]);
  (* The polygon crosses the line to the left of its place once. *)
  define "shape_star" 12 (fun a ->
      match Area.star (point a 0) (point a 2) (List.map (point a) [ 4; 6; 8; 10 ]) with
      | Some ((area, error), S O) -> doubles [ area; error ]
      | _ -> "none")

let rec nat k = if k = 0 then O else S (nat (k - 1))

let define_stars () =
  let places = [ 0; 1; 2; 3; 4 ] in
  let infinite = b64_of_bits (Whole.of_string "0x7ff0000000000000") in
  let nan = fsub infinite infinite in
  let ghost a = Whole.to_int (rounded a 23) in
  let star a = List.map (fun q -> if q = ghost a then (nan, nan) else point a (3 + (2 * q))) places in
  define "star_radius" 6 (fun a -> bits (radius (double a 0) (double a 1) (box_at a 2)));
  define "others_farther" 15 (fun a ->
      let neighbours = List.map (fun q -> point a (2 * q)) places in
      yes (others_farther neighbours (nat (Whole.to_int (rounded a 13))) (point a 10) (double a 12) (flag a 14)));
  define "certify_edges" 24 (fun a ->
      let centre q = point a (13 + (2 * ((q + 5) mod 5))) in
      all
        (fun q ->
          let edge = star_edge (point a 0) (centre q) (centre (q - 1)) (star a) (nat q) in
          yes (q <> ghost a && edge (ghost a >= 0) (double a 2)))
        places);
  (* The edge to the ghost, and its twin: bits 0 and 1. *)
  define "certify_hull" 24 (fun a ->
      let sure = star_hull (point a 0) (star a) (nat (ghost a)) (double a 2) in
      all (fun q -> if q = ghost a && sure then "3" else "0") places)

let define_all () =
  define_signs ();
  define_parts ();
  define_bounds ();
  define_boxes ();
  define_near ();
  define_stars ()
