(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The last part of the checker of certificates: the outcome "fixpoint", when it is known which sites stay where they are.
   CheckerStillSound.v says what follows. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerTies.
Import ListNotations.
Open Scope Z_scope.

(* Boxes that may be narrowed, by name: they are not points, and not among the sites that stay. *)
Definition movable (still : list Z) (boxes : list box) : list box :=
  let m := index (fun i => i) still in
  kept (fun b => negb (is_point b) && match Map.find (box_name b) m with Some _ => false | None => true end) boxes.

Definition is_in {A : Type} (m : Map.t A) (i : Z) : bool := match Map.find i m with Some _ => true | None => false end.

(* ---- who of them is in a pair with whom ---- *)

Definition partners (m : Map.t (list Z)) (i : Z) : list Z := match Map.find i m with Some l => l | None => [] end.

Definition add_partner (moves : Map.t box) (m : Map.t (list Z)) (i k : Z) : Map.t (list Z) :=
  if is_in moves k then Map.add i (k :: partners m i) m else m.

Definition movable_partners (moves : Map.t box) (listed : list edge) : Map.t (list Z) :=
  fold_left (fun m e => add_partner moves (add_partner moves m (from e) (to e)) (to e) (from e)) listed (Map.empty (list Z)).

Definition is_point_of (m : Map.t box) (i : Z) : bool := match Map.find i m with Some b => is_point b | None => false end.

(* An open pair that nothing changes: both sites stay, and no site that may be narrowed is in a pair with both; if one
   of them is not a point, nor with either. *)
Definition stays_open (m moves : Map.t box) (near : Map.t (list Z)) (e : edge) : bool :=
  let a := partners near (from e) in let b := partners near (to e) in
  negb (is_in moves (from e)) && negb (is_in moves (to e)) &&
  match a, b with
  | [], [] => true
  | _, _ => is_point_of m (from e) && is_point_of m (to e) && forallb (fun k => negb (existsb (Z.eqb k) b)) a
  end.

(* Can nothing that is narrowed change anything? `complete`: all possible pairs are listed, and that is all that is asked
   of; `loose`: the open pairs that are not shown to be ties. Meaningful when `check` accepts. *)
Definition is_fixpoint (D E : Z) (sites : list site) (still : list Z) (complete : bool) (edges opened loose : list edge) : bool :=
  match scaled_sites D E sites with
  | Some boxes =>
    match movable still boxes with
    | [] => true
    | some =>
      let moves := index box_name some in
      let near := movable_partners moves (rev_append opened edges) in
      complete && forallb (stays_open (index box_name boxes) moves near) loose
    end
  | None => false
  end.
