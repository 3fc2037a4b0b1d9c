(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The sixth part of the checker of certificates: inner polygons of the Voronoi diagram, and the area that they leave of
   a window. CheckerDiagramSound.v states their meaning. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerBounds.
Import ListNotations.
Open Scope Z_scope.

Record polygon : Type := Polygon { owner : Z; vertices : list (number * number) }.

(* A rectangle of the plane; its name means nothing. *)
Definition window : Type := site.

Definition dot : Type := (Z * Z)%type.

Fixpoint scaled_dots (D E : Z) (l : list (number * number)) (before : list dot) : option (list dot) :=
  match l with
  | [] => Some (rev_append before [])
  | p :: rest =>
    match scaled D E (fst p), scaled D E (snd p) with
    | Some x, Some y => scaled_dots D E rest ((x, y) :: before)
    | _, _ => None
    end
  end.

(* ---- shape ---- *)

(* Positive iff a, b, c turn left. *)
Definition bend (a b c : dot) : Z := (fst b - fst a) * (snd c - snd a) - (snd b - snd a) * (fst c - fst a).

(* By x, then by y. *)
Definition goes_on (a b : dot) : bool := (fst a <? fst b) || ((fst a =? fst b) && (snd a <=? snd b)).

Definition first_of (o : dot) (l : list dot) : dot := fold_left (fun o a => if goes_on o a then o else a) l o.

Definition same (a b : dot) : bool := (fst a =? fst b) && (snd a =? snd b).

(* The same polygon, o first. *)
Fixpoint begun_at (o : dot) (before l : list dot) : list dot :=
  match l with
  | [] => rev_append before []
  | a :: rest => if same o a then a :: rev_append (rev_append rest []) (rev_append before []) else begun_at o (a :: before) rest
  end.

Definition begun (l : list dot) : list dot :=
  match l with [] => [] | a :: rest => begun_at (first_of a rest) [] l end.

(* Does each of b and the others but the last turn left to the next? *)
Fixpoint turns_left (a b : dot) (l : list dot) : bool :=
  match l with
  | [] => true
  | c :: rest => (0 <? bend a b c) && turns_left b c rest
  end.

(* Twice the area of the triangles from o, each of which must be seen counterclockwise. *)
Fixpoint fan_twice (o a : dot) (l : list dot) (before : Z) : option Z :=
  match l with
  | [] => Some before
  | b :: rest => let t := bend o a b in if 0 <? t then fan_twice o b rest (before + t) else None
  end.

(* Twice the area of a strictly convex polygon, counterclockwise. All of it is on one side of the vertex that is first by
   x, then by y, so triangles from there that turn left do not overlap, and the first and the last one are the turns there
   and at its neighbours. *)
Definition polygon_twice (l : list dot) : option Z :=
  match begun l with
  | o :: a :: b :: rest =>
    if forallb (goes_on o) (a :: b :: rest) && turns_left a b rest then fan_twice o a (b :: rest) 0 else None
  | _ => None
  end.

(* ---- where they are ---- *)

Definition is_within_window (w : box) (a : dot) : bool :=
  (x0 w <=? fst a) && (fst a <=? x1 w) && (y0 w <=? snd a) && (snd a <=? y1 w).

(* The vertex is surely nearest to the owner. *)
Definition is_inner (m : Map.t box) (t : tree) (i : Z) (a : dot) : bool := check_witness m t i i (fst a) (snd a).

Definition polygon_holds (D E : Z) (m : Map.t box) (t : tree) (w : box) (p : polygon) : option Z :=
  match scaled_dots D E (vertices p) [] with
  | Some l => if forallb (fun a => is_within_window w a && is_inner m t (owner p) a) l then polygon_twice l else None
  | None => None
  end.

(* The polygons that hold need rising owners: no site has two. *)
Fixpoint polygons_onto (D E : Z) (m : Map.t box) (t : tree) (w : box) (last : Z) (l : list polygon) (before : Z) : option Z :=
  match l with
  | [] => Some before
  | p :: rest =>
    if last <? owner p then
      match polygon_holds D E m t w p with
      | Some z => polygons_onto D E m t w (owner p) rest (before + z)
      | None => None
      end
    else None
  end.

(* Twice the area of all polygons, and the window. *)
Definition polygons_twice (D E : Z) (sites : list site) (w : window) (l : list polygon) : option (Z * box) :=
  match scaled_sites D E sites, scaled_site D E w with
  | Some boxes, Some b =>
    if check D E sites [] && (x0 b <? x1 b) && (y0 b <? y1 b) then
      match polygons_onto D E (index box_name boxes) (build deepest boxes) b (-1) l 0 with
      | Some z => Some (z, b)
      | None => None
      end
    else None
  | _, _ => None
  end.

Definition polygons_hold (D E : Z) (sites : list site) (w : window) (l : list polygon) : bool :=
  match polygons_twice D E sites w l with Some _ => true | None => false end.

(* Do they leave at most the bound of the window? *)
Definition undetermined_holds (D E : Z) (sites : list site) (w : window) (l : list polygon) (bound : number) : bool :=
  match polygons_twice D E sites w l with
  | Some (z, b) => at_most D E (2 * ((x1 b - x0 b) * (y1 b - y0 b)) - z) (Number (2 * man bound) (expo bound) (den bound))
  | None => false
  end.
