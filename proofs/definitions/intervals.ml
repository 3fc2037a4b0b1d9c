(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* intervals.c, expressions.c and areas.c *)
open Filters
open Harness

let define_intervals () =
  let one name f = define name 2 (fun a -> ends (f (interval a 0))) in
  let two name f = define name 4 (fun a -> ends (f (interval a 0) (interval a 2))) in
  define "dyd_down" 1 (fun a -> bits (down (double a 0)));
  define "dyd_up" 1 (fun a -> bits (up (double a 0)));
  define "dyd_iv_point" 1 (fun a -> ends (iv_point (double a 0)));
  one "dyd_iv_neg" iv_neg;
  one "dyd_iv_sqr" iv_sqr;
  one "dyd_iv_sqrt" iv_sqrt;
  two "dyd_iv_add" iv_add;
  two "dyd_iv_sub" iv_sub;
  two "dyd_iv_mul" iv_mul;
  two "dyd_iv_div" iv_div;
  define "dyd_iv_scale" 3 (fun a -> ends (iv_scale (interval a 0) (double a 2)));
  define "dyd_iv_span4" 4 (fun a -> ends (span4 (double a 0) (double a 1) (double a 2) (double a 3)));
  define "dyd_iv_sign" 2 (fun a -> integer (iv_sign (interval a 0)));
  define "iv_det2" 8 (fun a -> ends (iv_det2 (interval a 0) (interval a 2) (interval a 4) (interval a 6)))

let define_boxes () =
  define "sign_of_boxes" 12 (fun a ->
      let i = interval a in
      integer (sign_of_boxes (i 0) (i 2) (i 4) (i 6) (i 8) (i 10)));
  define "dyd_filter_incircle" 16 (fun a ->
      let i = interval a in
      integer (incircle_of_boxes (i 0) (i 2) (i 4) (i 6) (i 8) (i 10) (i 12) (i 14)));
  define "farther_along" 6 (fun a ->
      bits (farther_along (interval a 0) (double a 2) (double a 3) (double a 4) (double a 5)));
  define "dyd_filter_is_farther" 12 (fun a -> yes (is_farther (box_at a 0) (box_at a 4) (box_at a 8)))

let define_expressions () =
  let two name f = define name 4 (fun a -> ends (f (interval a 0) (interval a 2))) in
  two "glance_add" span_add;
  two "glance_multiply" span_mul;
  two "glance_divide" span_div;
  define "glance_negated" 2 (fun a -> ends (span_neg (interval a 0)));
  define "glance_absolute" 2 (fun a -> ends (span_abs (interval a 0)));
  define "glance_corners" 4 (fun a -> ends (corners (double a 0) (double a 1) (double a 2) (double a 3)));
  define "glance_square_root" 3 (fun a -> ends (span_sqrt (interval a 0) (flag a 2)));
  define "glance_power" 3 (fun a -> ends (span_power_signed (interval a 0) (rounded a 2)));
  define "dyd_filter_bits" 2 (fun a -> integer (filter_bits (interval a 0)));
  define "power_of_two" 1 (fun a -> bits (power_of_two (rounded a 0)));
  define "dyd_filter_round" 3 (fun a -> maybe ends (filter_round (interval a 0) (rounded a 2)))

let define_panes () =
  let centre (u, v) = ends u ^ " " ^ ends v in
  let roots = maybe (fun l -> String.concat " " (string_of_int (List.length l) :: List.map centre l)) in
  define "iv_two_points" 8 (fun a ->
      roots (Some [ Pane.two_points (interval a 0) (interval a 2) (interval a 4) (interval a 6) ]));
  define "iv_point_and_line" 7 (fun a ->
      roots (Pane.point_and_line (interval a 0) (interval a 2) (interval a 4)));
  define "iv_parallel_lines" 5 (fun a -> roots (Pane.parallel_lines (interval a 0) (interval a 2)));
  define "iv_crossing_lines" 4 (fun a -> roots (Pane.crossing_lines (interval a 0) (interval a 2)));
  define "outside_slab" 10 (fun a ->
      yes (Pane.outside_slab (interval a 0) (interval a 2) (interval a 4) (interval a 6) (flag a 8) (flag a 9)))

let define_areas () =
  let axis a k = Area.axis (double a k) (double a (k + 1)) (double a (k + 2)) (double a (k + 3)) in
  let axes name f = define name 8 (fun a -> pair (f (axis a 0) (axis a 4))) in
  define "two_sum" 2 (fun a -> pair (two_sum (double a 0) (double a 1)));
  define "fast_two_sum" 2 (fun a -> pair (fast_two_sum (double a 0) (double a 1)));
  define "dd_sub_d" 2 (fun a -> pair (dd_sub_d (double a 0) (double a 1)));
  define "dd_add" 4 (fun a -> pair (dd_add (point a 0) (point a 2)));
  define "dd_mul" 4 (fun a -> pair (dd_mul (point a 0) (point a 2)));
  define "dd_inflate" 2 (fun a -> pair (inflate (point a 0)));
  define "dd_lead_in_range" 2 (fun a -> yes (lead_in_range (point a 0)));
  define "area2_axis_set" 4 (fun a ->
      let x = axis a 0 in
      all pair (Area.ends x) ^ " " ^ all yes (Area.flags x));
  axes "area2_one" Area.one;
  axes "area2_corner" Area.corner;
  axes "area2_cross" Area.cross;
  define "dyd_filter_partial_edge_area2" 8 (fun a -> maybe pair (Area.hull (box_at a 0) (box_at a 4)))

let define_all () =
  define_intervals ();
  define_boxes ();
  define_expressions ();
  define_panes ();
  define_areas ()
