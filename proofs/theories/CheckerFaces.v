(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The second half of the checker of certificates: faces. It finds sites that are surrounded by sure triangles, or by
   sure triangles and the sure hull; CheckerComplete.v says what follows: all other pairs of such a site are illegal.
   Triangles, corners and fans are hints of any origin: hints that do not hold are dropped. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker.
Import ListNotations.
Open Scope Z_scope.

(* Three sites, counterclockwise. *)
Record triangle : Type := Triangle { ta : Z; tb : Z; tc : Z }.

(* A site, claimed to be a corner of the hull, and a direction outward. *)
Record corner : Type := Corner { vertex : Z; ux : Z; uy : Z }.

(* A site and others around it, counterclockwise; whole: the last is followed by the first. *)
Record fan : Type := Fan { centre : Z; spokes : list Z; whole : bool }.

(* Positive iff the lower left corners turn left. *)
Definition turn (a b c : box) : Z := (x0 b - x0 a) * (y0 c - y0 a) - (y0 b - y0 a) * (x0 c - x0 a).

(* ---- entries found in maps must be checked again ---- *)

Definition code (i j : Z) : Z := Z.shiftl i 32 + j.

Definition map_edges (edges : list edge) : Map.t edge := index (fun e => code (from e) (to e)) edges.

Definition is_legal (m : Map.t edge) (i j : Z) : bool :=
  negb (i =? j) &&
  match Map.find (code (Z.min i j) (Z.max i j)) m with
  | Some e => ((from e =? i) && (to e =? j)) || ((from e =? j) && (to e =? i))
  | None => false
  end.

(* By each of their sides. *)
Definition map_triangles (l : list triangle) : Map.t triangle :=
  add_all (fun t => code (ta t) (tb t)) l (add_all (fun t => code (tb t) (tc t)) l (index (fun t => code (tc t) (ta t)) l)).

Definition has_triangle (m : Map.t triangle) (a i j : Z) : bool :=
  match Map.find (code a i) m with
  | Some t => ((ta t =? a) && (tb t =? i) && (tc t =? j)) || ((tb t =? a) && (tc t =? i) && (ta t =? j)) ||
              ((tc t =? a) && (ta t =? i) && (tb t =? j))
  | None => false
  end.

(* ---- heights of a box in a direction, and the side of a line where it is ---- *)

Definition top (u v : Z) (b : box) : Z := (if 0 <=? u then u * x1 b else u * x0 b) + (if 0 <=? v then v * y1 b else v * y0 b).
Definition bottom (u v : Z) (b : box) : Z :=
  (if 0 <=? u then u * x0 b else u * x1 b) + (if 0 <=? v then v * y0 b else v * y1 b).

(* The greatest and the least turn a b k, for points k of the box h instead of lower left corners. *)
Definition turn_most (a b h : box) : Z :=
  let u := y0 a - y0 b in let v := x0 b - x0 a in top u v h - (u * x0 a + v * y0 a).
Definition turn_least (a b h : box) : Z :=
  let u := y0 a - y0 b in let v := x0 b - x0 a in bottom u v h - (u * x0 a + v * y0 a).

(* ---- triangles: legal sides, and no other site's corner inside ---- *)

(* Is the box off the triangle? [xa,xb] x [ya,yb] is a rectangle around it: most boxes are off that, which costs a
   comparison or two. *)
Definition off_triangle (a b c : box) (xa xb ya yb : Z) (h : box) : bool :=
  (xb <? x0 h) || (x1 h <? xa) || (yb <? y0 h) || (y1 h <? ya) ||
  (turn_most a b h <? 0) || (turn_most b c h <? 0) || (turn_most c a h <? 0).

Definition empty_triangle (t : tree) (a b c : box) : bool :=
  let xa := Z.min (x0 a) (Z.min (x0 b) (x0 c)) in let xb := Z.max (x0 a) (Z.max (x0 b) (x0 c)) in
  let ya := Z.min (y0 a) (Z.min (y0 b) (y0 c)) in let yb := Z.max (y0 a) (Z.max (y0 b) (y0 c)) in
  let off := off_triangle a b c xa xb ya yb in
  all_in off (fun k => (box_name k =? box_name a) || (box_name k =? box_name b) || (box_name k =? box_name c) ||
                       off (corner_of k)) t.

Definition check_triangle (m : Map.t box) (t : tree) (legal : Map.t edge) (f : triangle) : bool :=
  is_legal legal (ta f) (tb f) && is_legal legal (tb f) (tc f) && is_legal legal (tc f) (ta f) &&
  match Map.find (ta f) m, Map.find (tb f) m, Map.find (tc f) m with
  | Some a, Some b, Some c => (0 <? turn a b c) && empty_triangle t a b c
  | _, _, _ => false
  end.

(* ---- corners: beyond all others in a direction ---- *)

Definition check_corner (m : Map.t box) (t : tree) (c : corner) : bool :=
  match Map.find (vertex c) m with
  | Some b =>
    let least := bottom (ux c) (uy c) b in
    let below := fun k => top (ux c) (uy c) k <? least in
    all_in below (fun k => below k || (box_name k =? vertex c)) t
  | None => false
  end.

Definition is_corner (corners : Map.t corner) (v : Z) : bool :=
  match Map.find v corners with Some _ => true | None => false end.

(* ---- fans ---- *)

Fixpoint pairs (l : list Z) : list (Z * Z) :=
  match l with
  | x :: ((y :: _) as rest) => (x, y) :: pairs rest
  | _ => []
  end.

Definition ring (f : fan) : list Z := if whole f then spokes f ++ firstn 1 (spokes f) else spokes f.

(* All sites are between the first spoke and the last one. *)
Definition within (m : Map.t box) (t : tree) (f : fan) (first final : Z) : bool :=
  match Map.find (centre f) m, Map.find first m, Map.find final m with
  | Some a, Some b, Some c =>
    all_in (fun h => (0 <=? turn_least a b h) && (turn_most a c h <=? 0)) (fun k => (0 <=? turn a b k) && (turn a c k <=? 0)) t
  | _, _, _ => false
  end.

Definition check_fan (m : Map.t box) (t : tree) (triangles : Map.t triangle) (corners : Map.t corner) (f : fan) : bool :=
  forallb (fun s => has_triangle triangles (centre f) (fst s) (snd s)) (pairs (ring f)) &&
  match ring f with
  | first :: _ :: _ =>
    if whole f then true
    else let final := last (ring f) first in
      is_corner corners first && is_corner corners final && within m t f first final
  | _ => false
  end.

(* The triangles and the corners that hold; meaningful when `check` accepts. *)
Definition sure_triangles (D E : Z) (sites : list site) (edges : list edge) (l : list triangle) : list triangle :=
  match scaled_sites D E sites with
  | Some boxes => kept (check_triangle (index box_name boxes) (build deepest boxes) (map_edges edges)) l
  | None => []
  end.

Definition sure_corners (D E : Z) (sites : list site) (l : list corner) : list corner :=
  match scaled_sites D E sites with
  | Some boxes => kept (check_corner (index box_name boxes) (build deepest boxes)) l
  | None => []
  end.

(* The fans that hold; meaningful when `check` accepts. *)
Definition surrounded (D E : Z) (sites : list site) (edges : list edge) (triangles : list triangle)
    (corners : list corner) (fans : list fan) : list fan :=
  match scaled_sites D E sites with
  | Some boxes =>
    let m := index box_name boxes in let t := build deepest boxes in
    let good := map_triangles (kept (check_triangle m t (map_edges edges)) triangles) in
    let sure := index vertex (kept (check_corner m t) corners) in
    kept (check_fan m t good sure) fans
  | None => []
  end.

(* Tests that every site is the centre of one of these fans; any two sites that are not must be a legal pair. *)
Definition all_surrounded (sites : list site) (edges : list edge) (found : list fan) : bool :=
  let m := index centre found in let legal := map_edges edges in
  let rest := kept (fun s => match Map.find (name s) m with Some _ => false | None => true end) sites in
  forallb (fun s => forallb (fun t => (name s =? name t) || is_legal legal (name s) (name t)) rest) rest.
