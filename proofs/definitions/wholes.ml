(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* circles.c and fixed.c *)
open Filters
open Harness

let define_fixed () =
  let halves (low, high) = integers [ low; high ] in
  define "product" 2 (fun a -> halves (Fixed.product (whole a 0) (whole a 1)));
  define "sum" 4 (fun a -> halves (Fixed.sum (whole a 0, whole a 1) (whole a 2, whole a 3)));
  define "dyd_fixed_incircle" 8 (fun a ->
      let z = whole a in
      integer (fixed_incircle (z 0) (z 1) (z 2) (z 3) (z 4) (z 5) (z 6) (z 7)))

let define_signs () =
  define "compare_squares" 3 (fun a -> integer (compare_squares (whole a 0) (whole a 1) (whole a 2)));
  define "dyd_sqrt_sign" 3 (fun a -> integer (sqrt_sign (whole a 0) (whole a 1) (whole a 2)));
  define "dyd_sqrt2_sign" 5 (fun a -> integer (sqrt2_sign (whole a 0) (whole a 1) (whole a 2) (whole a 3) (whole a 4)))

let define_centres () =
  let centre k = integers (Circle.parts k) in
  (* has: 1 for x, 2 for y *)
  let feature has x y = Circle.feature (has land 1 > 0) (has land 2 > 0) x y in
  let feature_at a k = feature (Whole.to_int (whole a k)) (whole a (k + 1)) (whole a (k + 2)) in
  define "solve_circle" 7 (fun a -> maybe centre (Circle.solve (feature_at a 0) (feature_at a 3) (whole_flag a 6)));
  define "solve_two_points" 4 (fun a ->
      maybe centre (Circle.two_points (feature 3 (whole a 0) (whole a 1)) (feature 3 (whole a 2) (whole a 3))));
  define "solve_point_beside_line" 3 (fun a ->
      maybe centre (Circle.point_beside_line (whole a 0) (whole a 1) (whole_flag a 2)));
  define "solve_point_and_line" 6 (fun a ->
      let line = feature (if whole_flag a 4 then 2 else 1) (whole a 2) (whole a 3) in
      maybe centre (Circle.point_and_line (feature 3 (whole a 0) (whole a 1)) line (whole_flag a 5)));
  define "solve_parallel_lines" 4 (fun a ->
      maybe centre (Circle.parallel_lines (whole a 0) (whole a 1) (whole_flag a 2) (whole_flag a 3)));
  define "solve_crossing_lines" 3 (fun a -> centre (Circle.crossing_lines (whole a 0) (whole a 1) (whole_flag a 2)));
  List.iter
    (fun name -> define name 3 (fun a -> centre (Circle.rational (whole a 0) (whole a 1) (whole a 2))))
    [ "centre_make_rational"; "centre_make_positive" ]

let define_circles () =
  define "circle_set_radius" 8 (fun a ->
      let z = whole a in
      integers
        [ radius_a (z 0) (z 1) (z 2) (z 3) (z 4) (z 5) (z 6) (z 7); radius_b (z 0) (z 1) (z 2) (z 3) (z 5) (z 6) (z 7);
          Whole.mul (z 5) (z 5) ]);
  (* The sum stays as it is where no place is left. *)
  define "surd_add_square" 8 (fun a ->
      let z = whole a in
      if whole_flag a 7 then
        integers [ add_square_p (z 0) (z 2) (z 3) (z 4) (z 5) (z 6); add_square_q (z 1) (z 2) (z 3) (z 5) (z 6) ]
      else integers [ z 0; z 1 ]);
  define "within_slab" 8 (fun a ->
      let z = whole a in
      yes
        ((not (whole_flag a 6) || within_low (z 0) (z 1) (z 2) (z 3) (z 4))
        && (not (whole_flag a 7) || within_high (z 0) (z 1) (z 2) (z 3) (z 5))))

let () =
  Doubles.define_all ();
  Intervals.define_all ();
  define_fixed ();
  define_signs ();
  define_centres ();
  define_circles ();
  run ()
