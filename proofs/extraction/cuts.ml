(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* How the plane of centres is to be cut: a hint, as in hints.ml. Triangles are seen from the middle of the sites as a
   sphere is seen from its centre: the longest side is cut in its middle, up to powers of two. *)
module Integers = Z
open Checker
module Z = Integers

(* The whole plane is seen from o; s is the size of what the sites take up. *)
type view = { o : spot; s : float }

let digits = 60

(* The box around all, and by how many bits numbers may be shortened. *)
let extent boxes =
  let join h b =
    { h with x0 = Z.min h.x0 b.x0; x1 = Z.max h.x1 b.x1; y0 = Z.min h.y0 b.y0; y1 = Z.max h.y1 b.y1 }
  in
  let h = List.fold_left join (List.hd boxes) boxes in
  (h, max 0 (Z.numbits (Z.max (Z.sub h.x1 h.x0) (Z.sub h.y1 h.y0)) - digits))

let view_of h k =
  let half lo hi = Z.shift_right (Z.add lo hi) (k + 1) in
  let size = Z.shift_right (Z.max (Z.sub h.x1 h.x0) (Z.sub h.y1 h.y0)) (k + 1) in
  { o = { sx = half h.x0 h.x1; sy = half h.y0 h.y1; sw = Z.one }; s = Z.to_float (Z.max size Z.one) }

(* Coordinates with o as the origin. *)
let seen v g = (Z.sub g.sx (Z.mul v.o.sx g.sw), Z.sub g.sy (Z.mul v.o.sy g.sw), g.sw)

let length x y w = sqrt ((x *. x) +. (y *. y) +. (w *. w))

let norm v g = let x, y, w = seen v g in length (Z.to_float x /. v.s) (Z.to_float y /. v.s) (Z.to_float w)

(* The sine of the angle under which a side is seen. *)
let angle v a b =
  let xa, ya, wa = seen v a and xb, yb, wb = seen v b in
  let cross p q r s = Z.to_float (Z.sub (Z.mul p s) (Z.mul q r)) in
  length (cross xa ya xb yb /. (v.s *. v.s)) (cross xa wa xb wb /. v.s) (cross ya wa yb wb /. v.s) /. norm v a /. norm v b

let power r = Z.shift_left Z.one r

(* The nearest power of two, from 0 on. *)
let bits x = max 0 (int_of_float (Float.round (Float.log2 x)))

(* Weights of a and b whose sum is in the middle between them. *)
let weights v a b =
  let na = norm v a and nb = norm v b in
  if Z.sign a.sw > 0 && Z.sign b.sw > 0 then
    let step near far = Z.pred (power (max 1 (bits (1. +. (far /. near))))) in
    let na = na /. Z.to_float a.sw and nb = nb /. Z.to_float b.sw in
    if na <= nb then (Z.mul (step na nb) b.sw, a.sw) else (b.sw, Z.mul (step nb na) a.sw)
  else (power (bits (nb /. na)), power (bits (na /. nb)))

(* Twos in all three. *)
let common_twos x y w =
  let add found z = if Z.sign z = 0 then found else min found (Z.trailing_zeros z) in
  List.fold_left add max_int [ x; y; w ]

let cutting v side a b =
  let weight, other_weight = weights v a b in
  let sum p q = Z.add (Z.mul weight p) (Z.mul other_weight q) in
  let x = sum a.sx b.sx and y = sum a.sy b.sy and w = sum a.sw b.sw in
  let twos = common_twos x y w in
  let less z = Z.shift_right z twos in
  if twos = max_int then None
  else Some { side = Z.of_int side; weight; other_weight; divisor = power twos; middle = { sx = less x; sy = less y; sw = less w } }

let cut v a b c =
  let ab = angle v a b and bc = angle v b c and ca = angle v c a in
  if ab >= bc && ab >= ca then cutting v 0 a b else if bc >= ca then cutting v 1 b c else cutting v 2 c a

(* Number of triangles that may be examined. *)
let effort boxes = Z.of_int ((List.length boxes + 64) * 1024)
