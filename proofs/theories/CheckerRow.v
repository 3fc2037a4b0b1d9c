(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The fourteenth part of the checker of certificates: ties of points that a block shows to be on one line, with nobody beyond
   it. CheckerRowSound.v says what follows. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerEnclosure CheckerAlgebra CheckerBlock CheckerVanish CheckerFacts CheckerRing.
Import ListNotations.
Open Scope Z_scope.

(* Sites and where they are: three or more on one line. *)
Record tied_row : Type := Row { one_end : Z * place; other_end : Z * place; more : list (Z * place) }.

Section Row.

Variable most u : Z.
Variable st : state.
Variable cofactor_hint : poly -> cofactor.
Variable sites : list site.

Definition row_members (g : tied_row) : list (Z * place) := one_end g :: other_end g :: more g.
Definition row_fact (g : tied_row) : fact := OnLine (snd (one_end g)) (snd (other_end g)) (map snd (more g)).

(* On which side of the line is the rectangle seen to be? *)
Definition side_of_row (g : tied_row) (s : site) : Z :=
  let a := snd (one_end g) in let b := snd (other_end g) in
  let dx := less most st (side_known u (left s) (right s)) (number_at st (at_first a)) in
  let dy := less most st (side_known u (low s) (high s)) (number_at st (at_second a)) in
  sign_of (within (cross most u st (step_x most st a b) (step_y most st a b) dx dy)).

Definition all_beside (g : tied_row) (z : Z) : bool :=
  forallb (fun s => existsb (fun m => name s =? fst m) (row_members g) || (side_of_row g s =? z)) sites.
Definition is_free_row (g : tied_row) : bool := fact_holds most u st cofactor_hint (row_fact g) && (all_beside g 1 || all_beside g (-1)).

Definition row_there (g : tied_row) : list (Z * place) :=
  filter (fun m => existsb (fun s => name s =? fst m) sites) (row_members g).

(* Is m between a and b, when all are on one line? *)
Definition is_between (a b m : place) : bool :=
  sign_of (within (sum_with most st (product_with most u st (step_x most st m a) (step_x most st m b))
    (product_with most u st (step_y most st m a) (step_y most st m b)))) =? -1.

Definition row_tie (l : list (Z * place)) (e : edge) : bool :=
  match place_of l (from e), place_of l (to e) with
  | Some a, Some b =>
    existsb (fun m => negb (fst m =? from e) && negb (fst m =? to e) && is_between a b (snd m)) l
  | _, _ => false
  end.

(* The pairs that the row does not show to be ties. *)
Definition row_loose (g : tied_row) (pairs : list edge) : list edge :=
  if is_free_row g then let l := row_there g in kept (fun e => negb (row_tie l e)) pairs else pairs.

End Row.
