(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What makes the checker of certificates quick: a tree of boxes answers a question about all boxes of a list by looking
   at few of them, and an index finds things by a number. Nothing here is a hint from outside: both are made from the
   list, and the theorems say that none of it is omitted. No function is recursive but at its end, or in the depth of a
   tree: lists are long. *)
From Coq Require Import ZArith List Bool Lia FMapAVL OrderedTypeEx.
Import ListNotations.
Open Scope Z_scope.

Module Map := FMapAVL.Make Z_as_OT.

(* ---- things by number: the last of the list that has it ---- *)

Definition add_all {A : Type} (key : A -> Z) (l : list A) (m : Map.t A) : Map.t A :=
  fold_left (fun m x => Map.add (key x) x m) l m.

Definition index {A : Type} (key : A -> Z) (l : list A) : Map.t A := add_all key l (Map.empty A).

Lemma add_all_in {A : Type} (key : A -> Z) l m k x : Map.find k (add_all key l m) = Some x ->
  (In x l /\ key x = k) \/ Map.find k m = Some x.
Proof.
  revert m. induction l as [| t l IH]; intros m H; [now right |]. simpl in H.
  destruct (IH _ H) as [[I K] | F]; [left; split; [now right | exact K] |].
  destruct (Z.eq_dec (key t) k) as [E | N].
  - left. pose proof (Map.find_1 (Map.add_1 m t E)) as G. assert (x = t) by congruence. subst x. split; [now left | exact E].
  - right. apply Map.find_1. exact (Map.add_3 N (Map.find_2 F)).
Qed.

Lemma index_in {A : Type} (key : A -> Z) l k x : Map.find k (index key l) = Some x -> In x l /\ key x = k.
Proof.
  intros H. destruct (add_all_in key l (Map.empty A) k x H) as [G | G]; [exact G |].
  destruct (Map.empty_1 (Map.find_2 G)).
Qed.

(* Those of a list that pass, in any order. *)
Definition kept {A : Type} (f : A -> bool) (l : list A) : list A :=
  fold_left (fun found x => if f x then x :: found else found) l [].

Lemma kept_in {A : Type} (f : A -> bool) l x : In x (kept f l) -> In x l /\ f x = true.
Proof.
  unfold kept. assert (G : forall found, In x (fold_left (fun found x => if f x then x :: found else found) l found) ->
    (In x l /\ f x = true) \/ In x found); [| intros H; destruct (G [] H) as [G' | []]; exact G'].
  induction l as [| t l IH]; intros found H; [now right |]. simpl in H.
  destruct (IH _ H) as [[I F] | I]; [left; split; [now right | exact F] |].
  destruct (f t) eqn:F; [| now right]. destruct I as [-> | I]; [left; split; [now left | exact F] | now right].
Qed.

Lemma in_kept {A : Type} (f : A -> bool) l x : In x l -> f x = true -> In x (kept f l).
Proof.
  intros H F. unfold kept. assert (G : forall found, In x l \/ In x found ->
    In x (fold_left (fun found x => if f x then x :: found else found) l found)); [| apply G; now left].
  clear H. induction l as [| t l IH]; intros found H; simpl; [destruct H as [[] | H]; exact H |].
  apply IH. simpl in H. destruct H as [[-> | H] | H]; [right; rewrite F; now left | now left |].
  right. destruct (f t); [now right | exact H].
Qed.

(* ---- boxes ---- *)

(* A rectangle with integer ends, and the number of its site. *)
Record box : Type := Box { box_name : Z; x0 : Z; x1 : Z; y0 : Z; y1 : Z }.

Definition ordered (b : box) : Prop := x0 b <= x1 b /\ y0 b <= y1 b.

Definition covers (h b : box) : Prop := x0 h <= x0 b /\ x1 b <= x1 h /\ y0 h <= y0 b /\ y1 b <= y1 h.

Definition joined (a b : box) : box :=
  Box 0 (Z.min (x0 a) (x0 b)) (Z.max (x1 a) (x1 b)) (Z.min (y0 a) (y0 b)) (Z.max (y1 a) (y1 b)).

Definition hull (l : list box) : box :=
  match l with [] => Box 0 0 0 0 0 | b :: rest => fold_left joined rest b end.

(* The lower left corner. *)
Definition corner_of (b : box) : box := Box (box_name b) (x0 b) (x0 b) (y0 b) (y0 b).

Lemma covers_trans a b c : covers a b -> covers b c -> covers a c.
Proof. unfold covers. lia. Qed.

Lemma covers_corner h b : covers h b -> ordered b -> covers h (corner_of b).
Proof. unfold covers, ordered, corner_of. simpl. lia. Qed.

Lemma joined_covers a b : covers (joined a b) a /\ covers (joined a b) b.
Proof. unfold covers, joined. simpl. lia. Qed.

Lemma hull_covers l b : In b l -> covers (hull l) b.
Proof.
  destruct l as [| a l]; [intros [] |]. simpl. revert a b.
  induction l as [| t l IH]; intros a b H; simpl in *.
  - destruct H as [-> | []]. unfold covers. lia.
  - destruct (joined_covers a t) as [Ca Ct]. pose proof (IH _ _ (or_introl (eq_refl (joined a t)))) as C.
    destruct H as [<- | [<- | H]]; [exact (covers_trans _ _ _ C Ca) | exact (covers_trans _ _ _ C Ct) |].
    apply IH. now right.
Qed.

(* ---- the tree ---- *)

Inductive tree : Type := Leaf (l : list box) | Node (h : box) (s t : tree).

Definition divided (f : box -> bool) (l : list box) : list box * list box :=
  fold_left (fun s b => if f b then (b :: fst s, snd s) else (fst s, b :: snd s)) l ([], []).

(* In the middle of the longer side of what the lower left corners take up; the second half is empty when there is but one
   corner. *)
Definition halves (l : list box) : list box * list box :=
  match l with
  | [] => ([], [])
  | b :: rest =>
    let c := fold_left (fun h k => joined h (corner_of k)) rest (corner_of b) in
    if y1 c - y0 c <? x1 c - x0 c
    then let s := x0 c + x1 c in divided (fun k => 2 * x0 k <=? s) l
    else let s := y0 c + y1 c in divided (fun k => 2 * y0 k <=? s) l
  end.

Lemma divided_in f l b : In b l -> In b (fst (divided f l)) \/ In b (snd (divided f l)).
Proof.
  intros H. unfold divided. assert (G : In b l \/ In b (fst (@nil box, @nil box)) \/ In b (snd (@nil box, @nil box))) by now left.
  revert G. generalize (@nil box, @nil box). clear H.
  induction l as [| t l IH]; intros s H; simpl; [destruct H as [[] | H]; exact H |].
  apply IH. simpl in H. destruct (f t); simpl; tauto.
Qed.

Lemma halves_in l b : In b l -> In b (fst (halves l)) \/ In b (snd (halves l)).
Proof.
  destruct l as [| a l]; [intros [] |]. intros H. unfold halves. cbv zeta. destruct (_ <? _); now apply divided_in.
Qed.

(* Each cut halves what corners take up, so where the depth ends they are as good as in one place. *)
Fixpoint build (depth : nat) (l : list box) : tree :=
  match depth with
  | O => Leaf l
  | S d =>
    match halves l with
    | (s, t) => match t with [] => Leaf l | _ :: _ => Node (hull l) (build d s) (build d t) end
    end
  end.

(* Opaque: nothing is to be proved by unfolding a tree. *)
Definition deepest : nat.
Proof. exact 400%nat. Qed.

(* Tests that all boxes pass the test. `passes` may show of a box that all boxes it covers do. *)
Fixpoint all_in (passes test : box -> bool) (t : tree) : bool :=
  match t with
  | Leaf l => forallb test l
  | Node h s t => passes h || (all_in passes test s && all_in passes test t)
  end.

(* Each box has been tested, or one that covers it. *)
Lemma all_in_or passes test b : forall depth l, all_in passes test (build depth l) = true -> In b l ->
  test b = true \/ exists h, covers h b /\ passes h = true.
Proof.
  induction depth as [| d IH]; intros l H I; cbn [build] in H.
  - left. cbn [all_in] in H. rewrite forallb_forall in H. now apply H.
  - destruct (halves l) as [s t] eqn:Q. destruct t as [| c t]; cbn [all_in] in H.
    + left. rewrite forallb_forall in H. now apply H.
    + apply orb_true_iff in H. destruct H as [H | H]; [right; exists (hull l); split; [now apply hull_covers | exact H] |].
      apply andb_true_iff in H. destruct H as [Hs Ht]. pose proof (halves_in l b I) as G. rewrite Q in G.
      destruct G as [G | G]; [exact (IH s Hs G) | exact (IH (c :: t) Ht G)].
Qed.

Theorem all_in_each passes test b : (forall h b, covers h b -> ordered b -> passes h = true -> test b = true) ->
  ordered b -> forall depth l, all_in passes test (build depth l) = true -> In b l -> test b = true.
Proof.
  intros M O depth l H I. destruct (all_in_or passes test b depth l H I) as [T | (h & C & T)]; [exact T | exact (M h b C O T)].
Qed.
