(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The thirteenth part of the checker of certificates: ties of points that a block shows to be on one circle,
  with nobody
   inside. CheckerRingSound.v says what follows. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerEnclosure CheckerAlgebra CheckerBlock CheckerVanish CheckerFacts.
Import ListNotations.
Open Scope Z_scope.

(* Sites and where they are: four or more on one circle. *)
Record tied_ring : Type := Ring { first : Z * place; second : Z * place; third : Z * place; others : list (Z * place) }.

Section Ring.

Variable most u : Z.
Variable st : state.
Variable cofactor_hint : poly -> cofactor.
Variable sites : list site.

Definition members (g : tied_ring) : list (Z * place) := first g :: second g :: third g :: others g.
Definition ring_fact (g : tied_ring) : fact := OnCircle (snd (first g)) (snd (second g)) (snd (third g)) (map snd (others
  g)).

(* All numbers of a side. *)
Definition side_known (lo hi : number) : known :=
  let (a, b) := fraction_of lo in let (c, d) := fraction_of hi in
  Known (if (0 <? den lo) && (0 <? den hi) then join (fraction u a b) (fraction u c d) else None) None.

(* Is the rectangle seen to be off the disc of the circle? *)
Definition is_off (g : tied_ring) (base : circle_base) (s : site) : bool :=
  let dx := less most st (side_known (left s) (right s)) (number_at st (at_first (snd (first g)))) in
  let dy := less most st (side_known (low s) (high s)) (number_at st (at_second (snd (first g)))) in
  let off := sum_with most st
    (sum_with most st (product_with most u st dx (along_x base)) (product_with most u st dy (along_y base)))
    (product_with most u st (norm most u st dx dy) (area base)) in
  sign_of (within off) * sign_of (within (area base)) =? 1.

Definition is_empty_ring (g : tied_ring) : bool :=
  fact_holds most u st cofactor_hint (ring_fact g) &&
  let base := base_of most u st (snd (first g)) (snd (second g)) (snd (third g)) in
  forallb (fun s => existsb (fun m => name s =? fst m) (members g) || is_off g base s) sites.

Definition there (g : tied_ring) : list (Z * place) := filter (fun m => existsb (fun s => name s =? fst m) sites)
  (members g).

(* On which side of the line of a and b is m? *)
Definition side_of (a b m : place) : Z := sign_of (within (off_line most u st a b m)).

(* Two members on the two sides of the pair's line. *)
Definition is_crossed (l : list (Z * place)) (i j : Z) (a b : place) : bool :=
  let other := fun m => negb (fst m =? i) && negb (fst m =? j) in
  existsb (fun m => other m && (side_of a b (snd m) =? 1)) l && existsb (fun m => other m && (side_of a b (snd m) =?
    -1)) l.

Definition place_of (l : list (Z * place)) (i : Z) : option place :=
  match find (fun m => fst m =? i) l with Some m => Some (snd m) | None => None end.

Definition ring_tie (l : list (Z * place)) (e : edge) : bool :=
  match place_of l (from e), place_of l (to e) with
  | Some a, Some b => is_crossed l (from e) (to e) a b
  | _, _ => false
  end.

(* The pairs that the ring does not show to be ties. *)
Definition ring_loose (g : tied_ring) (pairs : list edge) : list edge :=
  if is_empty_ring g then let l := there g in kept (fun e => negb (ring_tie l e)) pairs else pairs.

End Ring.
