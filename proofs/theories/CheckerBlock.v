(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The eleventh part of the checker of certificates: blocks, which say what points are, number by number.
  Of each number
   there is an interval and a quotient in leaves; CheckerBlockSound.v says what follows. *)
From Coq Require Import ZArith NArith List Bool.
From Dyadel Require CheckerCycle.
From Dyadel Require Import Checker CheckerEnclosure CheckerInverse CheckerAlgebra.
Import ListNotations.
Open Scope Z_scope.

(* P / Q that a line states the number to be. *)
Definition stated : Type := option (poly * poly).

(* A line of a block. Other numbers are those of lines before, counted from 0. *)
Inductive line : Type :=
| Value (p q : poly)
| Plus (a b : Z) | Minus (a b : Z) | Times (a b : Z) | Divided (a b : Z) | Least (a b : Z) | Greatest (a b : Z)
| Power (a n : Z) | Opposite (a : Z) | Claim (a : Z) | Absolute (a : Z)
| SquareRoot (a : Z) (s : stated) | CubeRoot (a : Z) (s : stated)
| Cosine (a : Z) | Sine (a : Z) | Tangent (a : Z)
| Exponential (a : Z) | HyperbolicSine (a : Z) | HyperbolicCosine (a : Z) | HyperbolicTangent (a : Z)
| Inverse (f : inverse_function) (a : Z)
| Pi | Euler | Cycle (n : Z) | Root (r : bracket) (s : stated) | Callback.

(* What a leaf is: a multiple of a number, or made of the number a, or 2 cos (2 pi / n). *)
Inductive kind : Type := Multiple (c a : Z) | CosineOf (a : Z) | SineOf (a : Z) | ExpOf (a : Z) | ExpOne | HalfTurn
  | PartOfTurn (n : Z) | InverseOf (f : inverse_function) (a : Z).
Record leaf : Type := Leaf { leaf_kind : kind; leaf_at : interval; leaf_relation : option relation }.
Record known : Type := Known { within : interval; is : quotient_of }.
Record state : Type := State { numbers : Map.t known; leaves : list leaf }.

(* Of 2 cos (2 pi / n). *)
Definition most_order : Z := 1024.

Section Block.

Variable most : Z.
Variable root_hint : Z -> Z -> Z.
Variable zero_hint : Z -> bracket -> Z.
Variable u : Z.
(* pi. *)
Variable turn : interval.

Definition pi2 : interval := over 2 turn.

Section Step.

Variable st : state.
(* The number of the line. *)
Variable k : Z.

Definition relations : list (option relation) := map leaf_relation (leaves st).
Definition held : list interval := map leaf_at (leaves st).
Definition fresh : nat := length (leaves st).
Definition leaf_q (j : nat) : quotient_of := Some (variable j, constant 1).

Definition add_q := q_add most relations.
Definition sub_q := q_sub most relations.
Definition mul_q := q_mul most relations.

(* Of leaves before only. *)
Definition is_before (p : poly) : bool := forallb (fun t => Nat.leb (length (snd t)) fresh) p.

Definition enclose (p q : poly) : interval := quotient most u (enclose_poly most u held p) (enclose_poly most u held
  q).
Definition value_known (p q : poly) : option known :=
  if is_before p && is_before q && negb (sign_of (enclose_poly most u held q) =? 0)
  then Some (Known (enclose p q) (shortened most (reduced 0 relations p) (reduced 0 relations q))) else None.

(* The first leaf whose key, or (where that helps) its opposite, is x: its place, and is it the key? *)
Fixpoint find_leaf (helps : bool) (key : kind -> option quotient_of) (x : quotient_of) (j : nat) (l : list leaf) :
  option (nat * bool) :=
  match l with
  | [] => None
  | f :: l' =>
    match key (leaf_kind f) with
    | Some y =>
      if are_equal most relations y x then Some (j, true)
      else if helps && are_equal most relations y (q_neg x) then Some (j, false) else find_leaf helps key x (S j) l'
    | None => find_leaf helps key x (S j) l'
    end
  end.

Definition quotient_at (a : Z) : option quotient_of :=
  match Map.find a (numbers st) with Some x => Some (is x) | None => None end.
Definition angle_key (f : kind) : option quotient_of := match f with CosineOf a => quotient_at a | _ => None end.
Definition exp_key (f : kind) : option quotient_of :=
  match f with ExpOf a => quotient_at a | ExpOne => Some (q_integer 1) | _ => None end.
Definition inverse_key (f : inverse_function) (g : kind) : option quotient_of :=
  match f, g with
  | Logarithm, InverseOf Logarithm a | Arcsine, InverseOf Arcsine a
  | Arccosine, InverseOf Arccosine a | Arctangent, InverseOf Arctangent a => quotient_at a
  | _, _ => None
  end.

Definition is_sine (j : nat) (a : Z) : bool :=
  match nth_error (leaves st) j with Some f => match leaf_kind f with SineOf b => b =? a | _ => false end | None =>
    false end.

Definition new_angle (a : Z) (x : interval) : list leaf :=
  [Leaf (CosineOf a) (cosine most u x) None;
   Leaf (SineOf a) (sine most u pi2 x)
     (Some (Relation 2 (plus (constant 1) (minus (times (variable fresh) (variable fresh))))))].

(* ---- parts of the turn ---- *)

Definition integer_of (p : poly) : option Z := match p with [(c, [])] => Some c | _ => None end.

(* The leaf, when that is all. *)
Fixpoint only_leaf (j : nat) (m : monomial) : option nat :=
  match m with
  | [] => None
  | [e] => if (e =? 1)%N then Some j else None
  | e :: m' => if (e =? 0)%N then only_leaf (S j) m' else None
  end.

Definition is_half_turn (f : leaf) : bool := match leaf_kind f with HalfTurn => true | _ => false end.
Fixpoint find_half_turn (j : nat) (l : list leaf) : option nat :=
  match l with [] => None | f :: l' => if is_half_turn f then Some j else find_half_turn (S j) l' end.

(* n and d when x is 2 pi n / d. *)
Definition part_of_turn (x : quotient_of) : option (Z * Z) :=
  match x with
  | Some ([], _) => Some (0, 1)
  | Some ([(c, m)], q) =>
    match integer_of q, only_leaf 0 m with
    | Some d, Some j =>
      match nth_error (leaves st) j with Some f => if is_half_turn f then Some (c, 2 * d) else None | None => None end
    | _, _ => None
    end
  | _ => None
  end.

(* The leaf 2 cos (2 pi / n), and n. *)
Fixpoint find_part (j : nat) (l : list leaf) : option (nat * Z) :=
  match l with
  | [] => None
  | f :: l' => match leaf_kind f with PartOfTurn n => Some (j, n) | _ => find_part (S j) l' end
  end.

(* The value of f, lowest coefficient first, at leaf j. *)
Fixpoint in_leaf (j : nat) (f : list Z) : poly :=
  match f with [] => [] | c :: g => plus (constant c) (times (variable j) (in_leaf j g)) end.

(* cos (2 pi n / d), where the leaf has it. *)
Definition part_cosine (n d : Z) : quotient_of :=
  let (order, at_) := match find_part 0 (leaves st) with Some (j, order) => (order, Some j) | None => (1, None) end in
  if (0 <? order) && negb (d =? 0) && (order * n mod d =? 0) then
    let k := order * n / d mod order in
    let f := fst (CheckerCycle.chebyshev (Z.to_nat (Z.min k (order - k)))) in
    match at_ with
    | Some j => shortened most (reduced 0 relations (in_leaf j f)) (constant 2)
    | None => q_integer 1
    end
  else None.

(* The relation of 2 cos (2 pi / n), the leaf to be added. *)
Definition part_relation (n : Z) : option relation :=
  if (0 <? n) && (n <=? most_order) && CheckerCycle.cycle_is_psi (Z.to_nat n) then
    match rev (CheckerCycle.psi (Z.to_nat n)) with
    | 1 :: f => Some (Relation (N.of_nat (length f)) (minus (in_leaf fresh (rev f))))
    | _ => None
    end
  else None.

(* There is one at most. *)
Definition new_part (n : Z) : option (known * list leaf) :=
  match find_part 0 (leaves st), part_relation n with
  | None, Some r =>
    let c := cosine most u (over n (add turn turn)) in let x := add c c in
    Some (Known x (Some (reduced_by reductions fresh r (variable fresh), constant 1)), [Leaf (PartOfTurn n) x (Some r)])
  | _, _ => None
  end.

(* The cosine and the sine of number a. *)
Definition angle (a : Z) (x : known) : option (quotient_of * quotient_of * list leaf) :=
  match is x with
  | None => None
  | Some _ =>
    match part_of_turn (is x) with
    | Some (n, d) => Some (part_cosine n d, part_cosine (4 * n - d) (4 * d), [])
    | None =>
      match find_leaf true angle_key (is x) 0 (leaves st) with
      | Some (j, same) =>
        match nth_error (leaves st) j with
        | Some (Leaf (CosineOf b) _ _) =>
          if is_sine (S j) b then Some (leaf_q j, if same then leaf_q (S j) else q_neg (leaf_q (S j)), []) else None
        | _ => None
        end
      | None => Some (leaf_q fresh, leaf_q (S fresh), new_angle a (within x))
      end
    end
  end.

(* A number that is not a quotient in leaves is refused: a cosine that is none of the leaf's, a hyperbolic sine without
   its exponential. *)
Definition seen (x : known) (l : list leaf) : option (known * list leaf) :=
  match is x with Some _ => Some (x, l) | None => None end.

(* exp of a number known as x; f: the leaf that it makes when there is none. *)
Definition exp_known (f : kind) (x : known) : option (quotient_of * list leaf) :=
  match is x with
  | None => None
  | Some _ =>
    if is_null (is x) then Some (q_integer 1, [])
    else match find_leaf true exp_key (is x) 0 (leaves st) with
    | Some (j, same) => Some (if same then leaf_q j else q_inverse (leaf_q j), [])
    | None => Some (leaf_q fresh, [Leaf f (exponential most u (within x)) None])
    end
  end.

Definition plain (x : option known) : option (known * list leaf) := match x with Some y => Some (y,
  []) | None => None end.
Definition known_at (a : Z) : option known := Map.find a (numbers st).

Definition unary (a : Z) (f : known -> option (known * list leaf)) : option (known * list leaf) :=
  match known_at a with Some x => f x | None => None end.
Definition binary (a b : Z) (f : known -> known -> option known) : option (known * list leaf) :=
  match known_at a, known_at b with Some x, Some y => plain (f x y) | _, _ => None end.

Definition sum_of (x y : known) : known := Known (add (within x) (within y)) (add_q (is x) (is y)).
Definition difference_of (x y : known) : known := Known (sub (within x) (within y)) (sub_q (is x) (is y)).
Definition product_known (x y : known) : known := Known (mul most u (within x) (within y)) (mul_q (is x) (is y)).
Definition inverse_of (x : known) : option known :=
  if sign_of (within x) =? 0 then None else Some (Known (inverse u (within x)) (q_inverse (is x))).
Definition ratio_of (x y : known) : option known :=
  match inverse_of y with Some z => Some (product_known x z) | None => None end.

(* Which of the two is it? Nothing, when it is not seen. *)
Definition extreme_is (s : Z) (x y : known) : quotient_of :=
  if are_equal most relations (is x) (is y) then is x
  else if sign_of (sub (within x) (within y)) =? s then is x
  else if sign_of (sub (within x) (within y)) =? - s then is y else None.
Definition absolute_is (x : known) : quotient_of :=
  if is_null (is x) || (sign_of (within x) =? 1) then is x else if sign_of (within x) =? -1 then q_neg (is x) else
    None.

(* A leaf c x, whose power is rest, and x. *)
Definition new_root (c : Z) (n : N) (r : poly) (x : interval) : known * list leaf :=
  (Known x (Some (variable fresh, constant c)),
    [Leaf (Multiple c k) (mul most u (whole u c) x) (Some (Relation n r))]).

(* The square root, or the cube root. *)
Definition radical_of (cubic : bool) (x : known) (s : stated) : option (known * list leaf) :=
  let y := if cubic then cube_root root_hint u (within x) else square_root root_hint u (within x) in
  match s with
  | Some (p, q) =>
    match value_known p q with
    | Some v =>
      let w := mul_q (is v) (is v) in
      if are_equal most relations (if cubic then mul_q (is v) w else w) (is x) &&
         (cubic || is_null (is v) || (sign_of (within v) =? 1))
      then Some (Known y (is v), []) else None
    | None => None
    end
  | None =>
    if is_null (is x) then Some (x, [])
    else match is x with
    | Some (p, q) =>
      match integer_of q with
      | Some c =>
        if negb (c =? 0) && (cubic || (sign_of (within x) =? 1))
        then Some (if cubic then new_root c 3 (times (constant (c * c)) p) y else new_root c 2 (times (constant c) p) y)
        else None
      | None => None
      end
    | None => None
    end
  end.

(* f_0 a^(n-1), f_1 a^(n-2), ..., f_(n-1), and a^n, for f of n coefficients. *)
Fixpoint monic_rest (a : Z) (f : list Z) : list Z * Z :=
  match f with
  | [] => ([], 1)
  | c :: g => let (h, w) := monic_rest a g in (c * w :: h, w * a)
  end.

Definition polynomial_root (r : bracket) (s : stated) : option (known * list leaf) :=
  let x := enclose_root u r (zero_hint u r) in
  if negb (is_single most u r) then None
  else match s with
  | Some (p, q) =>
    match value_known p q with
    | Some v =>
      if is_null (q_horner most relations (coefficients r) (is v)) &&
         (sign_of (sub (within v) (fraction u (lo_num r) (lo_den r))) =? 1) &&
         (sign_of (sub (fraction u (hi_num r) (hi_den r)) (within v)) =? 1)
      then Some (Known x (is v), []) else None
    | None => None
    end
  | None =>
    match rev (coefficients r) with
    | a :: f =>
      if a =? 0 then None
      else Some (new_root a (N.of_nat (length f)) (minus (in_leaf fresh (fst (monic_rest a (rev f))))) x)
    | [] => None
    end
  end.

Definition half : quotient_of := q_fraction most 1 2.

(* (y - 1/y) / 2 and (y + 1/y) / 2 for y = exp x. No leaf is made: the kind means nothing. *)
Definition hyperbolic (x : known) : known * known :=
  let y := exponential most u (within x) in let z := inverse u y in
  let e := match exp_known (SineOf 0) x with Some (e, []) => e | _ => None end in
  let f := q_inverse e in
  (Known (over 2 (sub y z)) (mul_q half (sub_q e f)), Known (over 2 (add y z)) (mul_q half (add_q e f))).

(* ---- inverse functions ---- *)

(* Is it seen to be at most 1? *)
Definition is_up_to_one (x : known) : bool :=
  are_equal most relations (is x) (q_integer 1) || match within x with Some (_, b) => b <=? u | None => false end.
Definition is_in_domain (f : inverse_function) (x : known) : bool :=
  match f with
  | Logarithm => sign_of (within x) =? 1
  | Arcsine | Arccosine => is_up_to_one x && is_up_to_one (Known (neg (within x)) (q_neg (is x)))
  | Arctangent => true
  end.

(* f of number a, known as x: only its interval is known, and that it is f of equal numbers. *)
Definition inverse_known (f : inverse_function) (a : Z) (x : known) : option (known * list leaf) :=
  let y := inverse_value most root_hint u pi2 f (within x) in
  match is x with
  | Some _ =>
    if negb (is_in_domain f x) then None
    else match find_leaf false (inverse_key f) (is x) 0 (leaves st) with
    | Some (j, _) => Some (Known y (leaf_q j), [])
    | None => Some (Known y (leaf_q fresh), [Leaf (InverseOf f a) y None])
    end
  | None => None
  end.

(* Enclosures of functions are sought of numbers below 2^n, as by the C code. *)
Definition up_to (n : Z) (x : known) : known :=
  Known (if extent (within x) <? Z.shiftl u n then within x else None) (is x).
Definition unary_up_to (n a : Z) (f : known -> option (known * list leaf)) : option (known * list leaf) :=
  unary a (fun x => f (up_to n x)).
Definition most_angle : Z := 24.
Definition most_power : Z := 8.

Definition step (o : line) : option (known * list leaf) :=
  match o with
  | Value p q => plain (value_known p q)
  | Plus a b => binary a b (fun x y => Some (sum_of x y))
  | Minus a b => binary a b (fun x y => Some (difference_of x y))
  | Times a b => binary a b (fun x y => Some (product_known x y))
  | Divided a b => binary a b ratio_of
  | Least a b => binary a b (fun x y => Some (Known (least (within x) (within y)) (extreme_is (-1) x y)))
  | Greatest a b => binary a b (fun x y => Some (Known (greatest (within x) (within y)) (extreme_is 1 x y)))
  | Power a n =>
    unary a (fun x => if (n <? 0) && (sign_of (within x) =? 0) then None
      else plain (Some (Known (power_Z most u (within x) n) (q_power_Z most relations (is x) n))))
  | Opposite a => unary a (fun x => plain (Some (Known (neg (within x)) (q_neg (is x)))))
  | Claim a => unary a (fun x => plain (Some x))
  | Absolute a => unary a (fun x => plain (Some (Known (absolute (within x)) (absolute_is x))))
  | SquareRoot a s => unary a (fun x => radical_of false x s)
  | CubeRoot a s => unary a (fun x => radical_of true x s)
  | Cosine a =>
    unary_up_to most_angle a (fun x => match angle a x with
      | Some (c, _, l) => seen (Known (cosine most u (within x)) c) l
      | None => None
      end)
  | Sine a =>
    unary_up_to most_angle a (fun x => match angle a x with
      | Some (_, s, l) => seen (Known (sine most u pi2 (within x)) s) l
      | None => None
      end)
  | Tangent a =>
    unary_up_to most_angle a (fun x => match angle a x with
      | Some (c, s, l) =>
        match ratio_of (Known (sine most u pi2 (within x)) s) (Known (cosine most u (within x)) c) with
        | Some y => seen y l
        | None => None
        end
      | None => None
      end)
  | Exponential a =>
    unary_up_to most_power a (fun x => match exp_known (ExpOf a) x with
      | Some (e, l) => Some (Known (exponential most u (within x)) e, l)
      | None => None
      end)
  | HyperbolicSine a => unary_up_to most_power a (fun x => seen (fst (hyperbolic x)) [])
  | HyperbolicCosine a => unary_up_to most_power a (fun x => seen (snd (hyperbolic x)) [])
  | HyperbolicTangent a =>
    unary_up_to most_power a (fun x => match ratio_of (fst (hyperbolic x)) (snd (hyperbolic x)) with
      | Some y => seen y []
      | None => None
      end)
  | Inverse f a => unary a (inverse_known f a)
  | Pi =>
    match find_half_turn 0 (leaves st) with
    | Some j => Some (Known turn (leaf_q j), [])
    | None => Some (Known turn (leaf_q fresh), [Leaf HalfTurn turn None])
    end
  | Euler =>
    let one := Known (whole u 1) (q_integer 1) in
    match exp_known ExpOne one with Some (e, l) => Some (Known (exponential most u (whole u 1)) e,
      l) | None => None end
  | Cycle n => new_part n
  | Root r s => polynomial_root r s
  | Callback => Some (Known None (leaf_q fresh), [Leaf (Multiple 1 k) None None])
  end.

End Step.

(* All lines, the first of which is line k; or the first that is refused. *)
Fixpoint run (st : state) (k : Z) (l : list line) : state + Z :=
  match l with
  | [] => inl st
  | o :: rest =>
    match step st k o with
    | Some (x, more) => run (State (Map.add k x (numbers st)) (leaves st ++ more)) (k + 1) rest
    | None => inr k
    end
  end.

End Block.

Definition nothing : state := State (Map.empty known) [].
