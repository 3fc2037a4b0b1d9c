(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The second half of the checker of certificates: faces. It finds sites that are surrounded by sure triangles, or by sure
   triangles and the sure hull; CheckerComplete.v says what follows: all other pairs of such a site are illegal.
   Triangles, corners and fans are hints of any origin: those that do not hold are left out. *)
From Coq Require Import ZArith List Bool FMapPositive.
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

(* ---- maps: what is found in them must be looked at again ---- *)

Definition code (i j : Z) : positive := Z.to_pos (Z.shiftl i 28 + j + 1).

Definition map_edges (edges : list edge) : PositiveMap.t edge :=
  fold_right (fun e m => PositiveMap.add (code (from e) (to e)) e m) (PositiveMap.empty edge) edges.

Definition is_legal (m : PositiveMap.t edge) (i j : Z) : bool :=
  negb (i =? j) &&
  match PositiveMap.find (code (Z.min i j) (Z.max i j)) m with
  | Some e => ((from e =? i) && (to e =? j)) || ((from e =? j) && (to e =? i))
  | None => false
  end.

Definition map_triangles (l : list triangle) : PositiveMap.t triangle :=
  fold_right (fun t m => PositiveMap.add (code (ta t) (tb t)) t (PositiveMap.add (code (tb t) (tc t)) t
    (PositiveMap.add (code (tc t) (ta t)) t m))) (PositiveMap.empty triangle) l.

Definition has_triangle (m : PositiveMap.t triangle) (a i j : Z) : bool :=
  match PositiveMap.find (code a i) m with
  | Some t => ((ta t =? a) && (tb t =? i) && (tc t =? j)) || ((tb t =? a) && (tc t =? i) && (ta t =? j)) ||
              ((tc t =? a) && (ta t =? i) && (tb t =? j))
  | None => false
  end.

(* ---- triangles: legal sides, and no other site's corner inside ---- *)

Definition off_triangle (a b c : box) (xa xb ya yb : Z) (k : box) : bool :=
  (xb <? x0 k) || (x0 k <? xa) || (yb <? y0 k) || (y0 k <? ya) ||
  (turn a b k <? 0) || (turn b c k <? 0) || (turn c a k <? 0).

Definition empty_triangle (boxes : list box) (a b c : box) : bool :=
  let xa := Z.min (x0 a) (Z.min (x0 b) (x0 c)) in let xb := Z.max (x0 a) (Z.max (x0 b) (x0 c)) in
  let ya := Z.min (y0 a) (Z.min (y0 b) (y0 c)) in let yb := Z.max (y0 a) (Z.max (y0 b) (y0 c)) in
  forallb (fun k => off_triangle a b c xa xb ya yb k || (box_name k =? box_name a) || (box_name k =? box_name b) ||
                    (box_name k =? box_name c)) boxes.

Definition check_triangle (boxes : list box) (legal : PositiveMap.t edge) (t : triangle) : bool :=
  is_legal legal (ta t) (tb t) && is_legal legal (tb t) (tc t) && is_legal legal (tc t) (ta t) &&
  match find_box boxes (ta t), find_box boxes (tb t), find_box boxes (tc t) with
  | Some a, Some b, Some c => (0 <? turn a b c) && empty_triangle boxes a b c
  | _, _, _ => false
  end.

(* ---- corners: beyond all others in a direction ---- *)

Definition top (u v : Z) (b : box) : Z := (if 0 <=? u then u * x1 b else u * x0 b) + (if 0 <=? v then v * y1 b else v * y0 b).
Definition bottom (u v : Z) (b : box) : Z :=
  (if 0 <=? u then u * x0 b else u * x1 b) + (if 0 <=? v then v * y0 b else v * y1 b).

Definition check_corner (boxes : list box) (c : corner) : bool :=
  match find_box boxes (vertex c) with
  | Some b => let least := bottom (ux c) (uy c) b in
    forallb (fun k => (top (ux c) (uy c) k <? least) || (box_name k =? vertex c)) boxes
  | None => false
  end.

Definition is_corner (corners : list corner) (v : Z) : bool := existsb (fun c => vertex c =? v) corners.

(* ---- fans ---- *)

Fixpoint pairs (l : list Z) : list (Z * Z) :=
  match l with
  | x :: ((y :: _) as rest) => (x, y) :: pairs rest
  | _ => []
  end.

Definition ring (f : fan) : list Z := if whole f then spokes f ++ firstn 1 (spokes f) else spokes f.

(* All sites are between the first spoke and the last one. *)
Definition within (boxes : list box) (f : fan) (first final : Z) : bool :=
  match find_box boxes (centre f), find_box boxes first, find_box boxes final with
  | Some a, Some b, Some c => forallb (fun k => (0 <=? turn a b k) && (turn a c k <=? 0)) boxes
  | _, _, _ => false
  end.

Definition check_fan (boxes : list box) (triangles : PositiveMap.t triangle) (corners : list corner) (f : fan) : bool :=
  forallb (fun s => has_triangle triangles (centre f) (fst s) (snd s)) (pairs (ring f)) &&
  match ring f with
  | first :: _ :: _ =>
    if whole f then true
    else let final := last (ring f) first in
      is_corner corners first && is_corner corners final && within boxes f first final
  | _ => false
  end.

(* The fans that hold; meaningful when `check` accepts. *)
Definition surrounded (D E : Z) (sites : list site) (edges : list edge) (triangles : list triangle)
    (corners : list corner) (fans : list fan) : list fan :=
  match scaled_sites D E sites with
  | Some boxes =>
    let good := map_triangles (filter (check_triangle boxes (map_edges edges)) triangles) in
    let sure := filter (check_corner boxes) corners in
    filter (check_fan boxes good sure) fans
  | None => []
  end.

(* Is every site the centre of one of these fans? *)
Definition all_surrounded (sites : list site) (found : list fan) : bool :=
  forallb (fun s => existsb (fun f => centre f =? name s) found) sites.
