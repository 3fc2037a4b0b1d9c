(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The seventh part of the checker of certificates: the distance of undetermined points to the Voronoi diagram, by boxes
   that cover the window. CheckerDistanceSound.v states its meaning. Roots are hints of any origin. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerBounds CheckerCover.
Import ListNotations.
Open Scope Z_scope.

(* A site: with fewer digits, and exactly; 2^64 times its diameter is at most width. *)
Record far_site : Type := FarSite { rough : box; exact : box; width : Z }.

(* The squares of the least distance of two boxes; length2 is that of the greatest. *)
Definition off (p q r s : Z) : Z := Z.max 0 (Z.max (r - q) (p - s)).
Definition near2 (a b : box) : Z :=
  let u := off (x0 a) (x1 a) (x0 b) (x1 b) in let v := off (y0 a) (y1 a) (y0 b) (y1 b) in u * u + v * v.

Definition found_site : Type := (far_site * (Z * Z))%type.  (* near2 and length2 *)

Definition seen (q : box) (l : list far_site) : list found_site :=
  fold_left (fun found c => (c, (near2 q (rough c), length2 q (rough c))) :: found) l [].

Definition least_of (l : list found_site) (first : Z) : Z := fold_left (fun m c => Z.min m (snd (snd c))) l first.

(* Are the two rectangles disjoint? *)
Definition are_apart (a b : box) : bool := (x1 a <? x0 b) || (x1 b <? x0 a) || (y1 a <? y0 b) || (y1 b <? y0 a).

(* Of the sites within the bound, the farthest ones to one side: if any is disjoint from a rectangle, one of them is. *)
Definition better (f : box -> box -> bool) (best c : far_site) : far_site := if f (exact best) (exact c) then c else best.
Definition outermost (c : far_site) (l : list far_site) : list far_site :=
  map (fun f => fold_left (better f) l c)
    [(fun a b => x0 a <? x0 b); (fun a b => x1 b <? x1 a); (fun a b => y0 a <? y0 b); (fun a b => y1 b <? y1 a)].
Definition all_outermost (l : list far_site) : list far_site := match l with [] => [] | c :: rest => outermost c rest end.

Definition is_apart_from_some (l : list far_site) (a : far_site) : bool := existsb (fun k => are_apart (exact a) (exact k)) l.

Section Roots.
Variable root : Z -> Z.
Variables (p q : Z).  (* the bound in units of rough boxes is p/q *)

(* A number whose square is at least z, or 0 and false. *)
Definition root_above (z : Z) : Z * bool := let r := root z in (r, (0 <=? r) && (z <=? r * r)).

(* A site that is possibly nearest: how far it is, and whether another one within the bound is disjoint from it. *)
Record possible_site : Type := PossibleSite { it : far_site; reach_of : Z; by_other : bool }.

Definition pair_is_near (a b : possible_site) : bool :=
  (by_other a && by_other b) ||
  let gap := near2 (exact (it a)) (exact (it b)) in
  let s := q * ((width (it a) + width (it b)) * (reach_of a + reach_of b)) in
  (0 <? gap) && (s * s <=? 4 * (p * p) * Z.shiftl gap 128).

Fixpoint pairs_are_near (l : list possible_site) : bool :=
  match l with [] => true | a :: rest => forallb (pair_is_near a) rest && pairs_are_near rest end.

Fixpoint possible_onto (edge : list far_site) (l : list found_site) (before : list possible_site) : option (list possible_site) :=
  match l with
  | [] => Some before
  | c :: rest =>
    let (r, good) := root_above (snd (snd c)) in
    if good then possible_onto edge rest (PossibleSite (fst c) r (is_apart_from_some edge (fst c)) :: before) else None
  end.

Definition count_of {A : Type} (l : list A) : Z := fold_left (fun n _ => n + 1) l 0.

Definition is_worth_a_look (count before : Z) : bool :=
  (count <=? 8) || ((count <=? 64) && (before <? 2 * count)) || ((count <=? 1024) && (7 * before <? 8 * count)).

Definition quarters (b : box) : list box :=
  let x := (x0 b + x1 b) / 2 in let y := (y0 b + y1 b) / 2 in
  [Box 0 (x0 b) x (y0 b) y; Box 0 x (x1 b) (y0 b) y; Box 0 (x0 b) x y (y1 b); Box 0 x (x1 b) y (y1 b)].

Variable most2 : Z.  (* at most the square of p/q *)

(* What of the effort is left when the box is covered; before: how many sites were possible around it. *)
Fixpoint box_holds (depth : nat) (effort before : Z) (b : box) (l : list far_site) : option Z :=
  let here := seen b l in
  match here with
  | [] => None
  | c :: _ =>
    let least := least_of here (snd (snd c)) in
    let some := kept (fun c => fst (snd c) <=? least) here in
    let edge := all_outermost (map fst (kept (fun c => snd (snd c) <=? most2) here)) in
    let count := count_of some in
    let left := effort - count_of l in
    let looked := is_worth_a_look count before in
    let left := if looked then left - 8 * (count * count) else left in
    if existsb (is_apart_from_some edge) edge then Some left
    else if looked && match possible_onto edge some [] with Some s => pairs_are_near s | None => false end then Some left
    else
      match depth with
      | O => None
      | S depth =>
        if (0 <? left) && ((x0 b + 1 <? x1 b) || (y0 b + 1 <? y1 b)) then
          let rest := map fst (kept (fun c => (fst (snd c) <=? least) || (fst (snd c) <=? most2)) here) in
          fold_left (fun left part => match left with Some e => box_holds depth e count part rest | None => None end)
            (quarters b) (Some left)
        else None
      end
  end.
End Roots.

Fixpoint far_sites (root : Z -> Z) (k : Z) (l : list box) (before : list far_site) : option (list far_site) :=
  match l with
  | [] => Some before
  | b :: rest =>
    let (r, good) := root_above root (Z.shiftl (diameter2 b) 128) in
    if good then far_sites root k rest (FarSite (coarse k b) b r :: before) else None
  end.

(* Is every undetermined point of the window within the bound of the diagram? *)
Definition distance_holds (root : Z -> Z) (k effort D E : Z) (sites : list site) (w : site) (bound : number) : bool :=
  match scaled_sites D E sites, scaled_site D E w with
  | Some boxes, Some b =>
    let j := expo bound + E - k in
    let p := Z.shiftl (man bound * D) (Z.max 0 j) in let q := Z.shiftl (den bound) (Z.max 0 (- j)) in
    check D E sites [] && (0 <=? man bound) && (0 <? den bound) && (0 <=? k) &&
    match far_sites root k boxes [] with
    | Some l => match box_holds root p q (p * p / (q * q)) deepest effort (count_of l) (coarse k b) l with Some _ => true | None => false end
    | None => false
    end
  | _, _ => false
  end.
