(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The thirteenth part of the checker of certificates: ties of points that a block shows to be on one circle with no
   site inside, or on one line with no site beyond. CheckerTiedSound.v says what follows. Which set shows a pair to be a
   tie, and which of its sites do so, are hints of any origin. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerTies CheckerEnclosure CheckerAlgebra CheckerBlock CheckerVanish CheckerFacts.
Import ListNotations.
Open Scope Z_scope.

(* A fact, and the sites that it is about; the facts known of the numbers of its block, units of them in 1, and hints of
   which polynomials are 0. *)
Record tied_set : Type := TiedSet { units : Z; block : state; null_hint : poly -> cofactor; says : fact; site_names : list Z }.

Definition places_of (f : fact) : list place :=
  match f with Same a b => [] | OnLine a b l => a :: b :: l | OnCircle a b c l => a :: b :: c :: l end.
Definition members (g : tied_set) : list (Z * place) := combine (site_names g) (places_of (says g)).

(* By which set a pair is a tie. Of a circle: sites on the two sides of the pair's line; of a line: one between, twice. *)
Record crossing : Type := Crossing { by_set : Z; one_side : Z; other_side : Z }.

Section Tied.

Variable most : Z.
Variable D E : Z.

(* All numbers of a side of a box; and the knowledge of a number reduced to its enclosure. *)
Definition side_known (u lo hi : Z) : known :=
  let d := Z.shiftl D (Z.max 0 E) in let z := fun n => fraction u (Z.shiftl n (Z.max 0 (- E))) d in
  Known (join (z lo) (z hi)) None.
Definition seen (x : known) : known := Known (within x) None.

Section Of_a_set.

Variable g : tied_set.
Let u := units g.
Let st := block g.
Let times_ := product_with most u st.
Let plus_ := sum_with most st.

Definition over_x (a b : place) : known := less most st (seen (number_at st (at_first b))) (seen (number_at st (at_first a))).
Definition over_y (a b : place) : known := less most st (seen (number_at st (at_second b))) (seen (number_at st (at_second a))).
Definition box_x (a : place) (h : box) : known := less most st (side_known u (x0 h) (x1 h)) (number_at st (at_first a)).
Definition box_y (a : place) (h : box) : known := less most st (side_known u (y0 h) (y1 h)) (number_at st (at_second a)).

(* Where all points of a box are: outside of the circle (1) or inside (-1); to the left or right of the line; 0: not seen. *)
Definition where_is : box -> Z :=
  match says g with
  | Same a b => fun _ => 0
  | OnLine a b _ =>
    let ex := over_x a b in let ey := over_y a b in fun h => sign_of (within (cross most u st ex ey (box_x a h) (box_y a h)))
  | OnCircle a b c _ =>
    let base := base_of most u st a b c in let turn := sign_of (within (area base)) in
    fun h =>
      let dx := box_x a h in let dy := box_y a h in
      let off := plus_ (plus_ (times_ dx (along_x base)) (times_ dy (along_y base))) (times_ (norm most u st dx dy) (area base)) in
      sign_of (within off) * turn
  end.

(* All sites but the members, whatever their points. *)
Definition all_are (t : tree) (z : Z) : bool :=
  let there := where_is in let own := index fst (members g) in
  all_in (fun h => there h =? z) (fun b => Map.mem (box_name b) own || (there b =? z)) t.

Definition is_free (t : tree) : bool :=
  fact_holds most u st (null_hint g) (says g) &&
  match says g with Same _ _ => false | OnLine _ _ _ => all_are t 1 || all_are t (-1) | OnCircle _ _ _ _ => all_are t 1 end.

(* On which side of the line of a and b is m? *)
Definition side_of (a b m : place) : Z :=
  sign_of (within (cross most u st (over_x a b) (over_y a b) (over_x a m) (over_y a m))).

(* Is m between a and b, when all are on one line? *)
Definition is_between (a b m : place) : bool :=
  sign_of (within (plus_ (times_ (over_x m a) (over_x m b)) (times_ (over_y m a) (over_y m b)))) =? -1.

Definition is_crossed (a b k l : place) : bool :=
  match says g with
  | Same _ _ => false
  | OnLine _ _ _ => is_between a b k
  | OnCircle _ _ _ _ => (side_of a b k =? 1) && (side_of a b l =? -1)
  end.

End Of_a_set.

(* Sets that are free, by number, each with its members by name. *)
Definition free_sets (t : tree) (sets : list (Z * tied_set)) : Map.t (tied_set * Map.t (Z * place)) :=
  fold_left (fun found s => if is_free (snd s) t then Map.add (fst s) (snd s, index fst (members (snd s))) found else found)
    sets (Map.empty _).

Definition set_tie (boxes : Map.t box) (free : Map.t (tied_set * Map.t (Z * place))) (e : edge) (h : crossing) : bool :=
  match Map.find (by_set h) free with
  | Some (g, own) =>
    let at_ := fun i => if Map.mem i boxes then Map.find i own else None in
    is_other e (one_side h) && is_other e (other_side h) &&
    match at_ (from e), at_ (to e), at_ (one_side h), at_ (other_side h) with
    | Some a, Some b, Some k, Some l => is_crossed g (snd a) (snd b) (snd k) (snd l)
    | _, _, _, _ => false
    end
  | None => false
  end.

(* The pairs that none of their hints shows to be ties; meaningful when `check` accepts. *)
Definition loose_of_sets (sites : list site) (sets : list (Z * tied_set)) (hint : edge -> list crossing) (pairs : list edge)
  : list edge :=
  match scaled_sites D E sites with
  | Some boxes =>
    let named := index box_name boxes in let free := free_sets (build deepest boxes) sets in
    kept (fun e => negb (existsb (set_tie named free e) (hint e))) pairs
  | None => pairs
  end.

End Tied.
